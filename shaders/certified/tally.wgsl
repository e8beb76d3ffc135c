// The counts and bounds that the host reads after a submission of several
// levels. CPU twin: `BatchResult` of `src/certified/search/mod.rs`.

struct Tally {
    // Cells written for the next level, which may be more than its buffer holds.
    next_cells: atomic<u32>,
    // Cells of the level after the last.
    waiting_cells: atomic<u32>,
    // Cells written to the buffer of leftover cells.
    leftover_cells: atomic<u32>,
    // Bits of the largest upper bound of a pruned cell.
    pruned_upper: atomic<u32>,
    // The farthest centre: bits of its distance, its subpatch and the bits of
    // its parameters. Threads may write them in any interleaving. Every
    // mixture is a point of A, whose distance the host computes in float64.
    farthest: atomic<u32>,
    farthest_subpatch: atomic<u32>,
    farthest_s: atomic<u32>,
    farthest_t: atomic<u32>,
    // Cells bounded, and levels with cells.
    cells: atomic<u32>,
    levels: atomic<u32>,
}
