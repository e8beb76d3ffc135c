// What a submission of levels tells the host.

struct Tally {
    // Cells written for the next level, which may be more than it has room for.
    next: atomic<u32>,
    // Cells of the level after the last.
    waiting: atomic<u32>,
    // Cells left over.
    left: atomic<u32>,
    // Bits of the largest bound of a cell that is decided.
    dropped: atomic<u32>,
    // The farthest centre met: bits of its distance, its cell's piece and
    // bits of its place. Threads may write in between each other: every
    // mixture is a point of A, and the host asks float64 how far it is.
    farthest: atomic<u32>,
    farthest_piece: atomic<u32>,
    farthest_s: atomic<u32>,
    farthest_t: atomic<u32>,
    // Cells bounded, and levels with any.
    cells: atomic<u32>,
    levels: atomic<u32>,
}
