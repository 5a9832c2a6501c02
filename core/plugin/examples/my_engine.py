"""The algorithm to try out: all pairs, in the plainest form."""


def find_pairs(boxes, is_static):
    pairs = []
    for i, a in enumerate(boxes):
        for j in range(i + 1, len(boxes)):
            b = boxes[j]
            if is_static[i] and is_static[j]:
                continue
            if all(a[k] <= b[k + 3] and b[k] <= a[k + 3] for k in range(3)):
                pairs.append((i, j))
    return pairs
