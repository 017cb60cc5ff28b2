"""Sets of whole numbers as sorted lists of half-open ranges (first, end): samples of a frame, frames of a film."""

Ranges = list[tuple[int, int]]


def union(a: Ranges, b: Ranges) -> Ranges:
    """Ranges that touch become one."""
    result: Ranges = []
    for first, end in sorted(a + b):
        if result and result[-1][1] >= first:
            result[-1] = (result[-1][0], max(result[-1][1], end))
        elif end > first:
            result.append((first, end))
    return result


def difference(a: Ranges, b: Ranges) -> Ranges:
    """What `a` has and `b` has not."""
    result = []
    for first, end in a:
        for taken_first, taken_end in b:
            if taken_end <= first or taken_first >= end:
                continue
            if taken_first > first:
                result.append((first, taken_first))
            first = max(first, taken_end)
        if end > first:
            result.append((first, end))
    return result


def size(ranges: Ranges) -> int:
    return sum(end - first for first, end in ranges)


def overlaps(a: Ranges, b: Ranges) -> bool:
    return size(difference(a, b)) < size(a)


def text(ranges: Ranges) -> str:
    """As render --samples takes them: 0-7,16."""
    return ",".join(f"{first}-{end - 1}" if end - first > 1 else f"{first}" for first, end in ranges)
