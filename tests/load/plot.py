"""Ages of frames as bars, an SVG: the median, and a line up to the 95th percentile."""

import math

WIDTH, HEIGHT, LEFT, BOTTOM, TOP = 900, 420, 70, 60, 40
COLOURS = ("#b5473c", "#d9a441", "#2f6f9f")


def svg(cells, controls):
    """`cells`: dicts with mbit, delay_ms, control and age_ms, in the order of the bars."""
    links = list(dict.fromkeys((cell["mbit"], cell["delay_ms"]) for cell in cells))
    ages = [cell["age_ms"][key] for cell in cells for key in ("p50", "p95")]
    low = 10 ** math.floor(math.log10(max(1, min(ages))))
    high = 10 ** math.ceil(math.log10(max(max(ages), low * 10)))
    plot_height = HEIGHT - TOP - BOTTOM

    def y(age):
        share = math.log(max(age, low) / low) / math.log(high / low)
        return HEIGHT - BOTTOM - share * plot_height

    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" '
             'font-family="sans-serif" font-size="12">',
             '<rect width="100%" height="100%" fill="white"/>',
             f'<text x="{LEFT}" y="20" font-size="14">Age of frames, ms: median (bar) and 95th '
             'percentile (line)</text>']
    tick = low
    while tick <= high:
        parts.append(f'<line x1="{LEFT}" x2="{WIDTH - 10}" y1="{y(tick):.1f}" y2="{y(tick):.1f}" '
                     f'stroke="#ddd"/><text x="{LEFT - 8}" y="{y(tick) + 4:.1f}" '
                     f'text-anchor="end">{tick:g}</text>')
        tick *= 10
    group = (WIDTH - LEFT - 10) / len(links)
    bar = group * 0.8 / len(controls)
    for i, link in enumerate(links):
        x = LEFT + i * group
        for cell in cells:
            if (cell["mbit"], cell["delay_ms"]) != link:
                continue
            place = controls.index(cell["control"])
            at, top, end = x + group * 0.1 + place * bar, y(cell["age_ms"]["p50"]), y(
                cell["age_ms"]["p95"])
            parts.append(f'<rect x="{at:.1f}" y="{top:.1f}" width="{bar * 0.9:.1f}" '
                         f'height="{HEIGHT - BOTTOM - top:.1f}" fill="{COLOURS[place]}"/>'
                         f'<line x1="{at + bar * 0.45:.1f}" x2="{at + bar * 0.45:.1f}" '
                         f'y1="{top:.1f}" y2="{end:.1f}" stroke="black"/>')
        parts.append(f'<text x="{x + group / 2:.1f}" y="{HEIGHT - BOTTOM + 18}" '
                     f'text-anchor="middle">{link[0]:g} Mbit/s</text>'
                     f'<text x="{x + group / 2:.1f}" y="{HEIGHT - BOTTOM + 34}" '
                     f'text-anchor="middle">{link[1]:g} ms</text>')
    for place, control in enumerate(controls):
        at = WIDTH - 330 + place * 110
        parts.append(f'<rect x="{at}" y="10" width="12" height="12" fill="{COLOURS[place]}"/>'
                     f'<text x="{at + 18}" y="20">{control}</text>')
    return "\n".join([*parts, "</svg>", ""])
