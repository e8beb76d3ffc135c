"""The table: what each peer answered, how wrong, how fast."""

from statistics import median

from nurbs import diagonal

# Relative to the larger diagonal: an error at most this counts as accurate.
ACCURATE = 1e-4

# Errors below this, relative to the diagonal, are rounding of either answer.
ROUNDING = 1e-9

OURS = "nurbs-hausdorff"


def rows(abouts, results):
    """One row a pair and peer. Errors are relative to the pair's larger diagonal."""
    table = []
    for pair, reference, answers in results:
        scale = max(diagonal(pair.a), diagonal(pair.b))
        lower, upper = interval(pair, reference, answers[0])
        ours = answers[0].get("seconds")
        for about, answer in zip(abouts, answers, strict=True):
            value, seconds = answer.get("value"), answer.get("seconds")
            outside = None if value is None else max(0.0, lower - value, value - upper) / scale
            table.append(
                {
                    "pair": pair.name,
                    "what": pair.what,
                    "peer": about["name"],
                    "guarantee": about["guarantee"],
                    "value": value,
                    "lower": lower,
                    "upper": upper,
                    "error": outside,
                    "width": (upper - lower) / scale,
                    "seconds": seconds,
                    "ratio": seconds / ours if seconds and ours else None,
                    "at_least": answer.get("limit", 0) / ours if ours and "limit" in answer else None,
                    "failed": answer.get("failed"),
                }
            )
    return table


def interval(pair, reference, ours):
    """What is known of the distance: a formula, or both certified intervals."""
    if pair.truth is not None:
        return pair.truth, pair.truth
    lower, upper = ours.get("interval") or (reference["lower"], reference["upper"])
    return max(reference["lower"], lower), min(reference["upper"], upper)


def markdown(abouts, table, rounds):
    """Settings, findings and one table a pair."""
    lines = [f"- **{about['name']}** ({about['guarantee']}): {about['settings']}" for about in abouts]
    lines += ["", *findings(table), ""]
    for pair in dict.fromkeys(row["pair"] for row in table):
        own = [row for row in table if row["pair"] == pair]
        lines += [
            f"### {pair}: {own[0]['what']}",
            "",
            f"True distance in [{own[0]['lower']:.10g}, {own[0]['upper']:.10g}]; "
            f"least of up to {rounds} times, peers in turn.",
            "",
            "| peer | value | error / diagonal | guarantee | time, ms | ratio |",
            "|---|---|---|---|---|---|",
            *map(line, own),
            "",
        ]
    return "\n".join(lines)


def line(row):
    """One peer's row."""
    if row["failed"]:
        ratio = f"> {row['at_least']:.1f}" if row["at_least"] else ""
        return f"| {row['peer']} | {row['failed']} | | {row['guarantee']} | | {ratio} |"
    error = f"{row['error']:.1e}" if row["error"] else "0"
    ratio = f"{row['ratio']:.2f}" if row["ratio"] else "ours gave none"
    return (
        f"| {row['peer']} | {row['value']:.9g} | {error} | {row['guarantee']} "
        f"| {1e3 * row['seconds']:.1f} | {ratio} |"
    )


def findings(table):
    """The required figures, and every row that misses one."""
    own = {row["pair"]: row for row in table if row["peer"] == OURS}
    peers = [row for row in table if row["peer"] != OURS]
    answered = [row for row in peers if row["seconds"] and own[row["pair"]]["seconds"]]
    accurate = [row for row in answered if row["error"] <= ACCURATE]
    faster = [row for row in accurate if row["ratio"] < 1]
    beaten = [row for row in faster if row["error"] + ROUNDING < own[row["pair"]]["error"]]
    # What ran into the limit counts with the limit: at least so much slower.
    cascade = [row["ratio"] or row["at_least"] for row in peers if row["peer"] == "OpenCASCADE"]
    cascade = [ratio for ratio in cascade if ratio]
    lines = [
        f"- Faster and more accurate than ours: {listed(beaten)}.",
        f"- Error at most {ACCURATE:g} of the diagonal and faster than ours: {listed(faster)}.",
    ]
    if accurate:
        ratios = [row["ratio"] for row in accurate]
        lines.append(
            f"- Answers with an error of at most {ACCURATE:g}: {len(ratios)}, slower than ours by a median "
            f"factor of {median(ratios):.1f} (least {min(ratios):.2f})."
        )
    if cascade:
        lines.append(
            f"- OpenCASCADE at 64 x 64 samples: slower by a median factor of at least {median(cascade):.1f} "
            f"(least {min(cascade):.2f}), those over the time limit counted with it; more than 20 times "
            f"slower on {sum(ratio > 20 for ratio in cascade)} of {len(cascade)} pairs."
        )
    for peer in dict.fromkeys(row["peer"] for row in peers):
        mine = [row for row in answered if row["peer"] == peer]
        if mine:
            right = [row for row in mine if row["error"] <= ACCURATE]
            worst, ratio = max(row["error"] for row in mine), median(row["ratio"] for row in mine)
            lines.append(
                f"- {peer}: {len(right)} of {len(own)} within {ACCURATE:g}, largest error {worst:.1e}, "
                f"median ratio {ratio:.1f}."
            )
    return lines


def listed(rows_):
    """Which, or that there are none."""
    return ", ".join(f"{row['peer']} on {row['pair']} ({row['ratio']:.2f}x)" for row in rows_) or "none"
