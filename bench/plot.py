"""A plot of a few lines as SVG: both axes logarithmic, a circle at every point, the line's name at its end."""
import math

WIDTH, HEIGHT = 560, 340
LEFT, RIGHT, TOP, BOTTOM = 64, 96, 36, 48
COLOURS = ("#1f5fa8", "#c2541b", "#3a7d44")


class Axis:
    """From the decade, or half of one, below the least value to that above the greatest."""
    STEPS = (1, 2, 5)

    def __init__(self, values, first, last):
        self.low, self.high = self.step(min(values), math.floor), self.step(max(values), math.ceil)
        if self.low == self.high:
            self.high = self.low * 10
        self.first, self.last = first, last

    def step(self, value, way):
        decade = 10.0 ** math.floor(math.log10(value))
        fitting = [s * decade for s in (*self.STEPS, 10)]
        return max(s for s in fitting if s <= value * (1 + 1e-9)) if way is math.floor else min(s for s in fitting if s >= value * (1 - 1e-9))

    def at(self, value):
        return self.first + (self.last - self.first) * math.log(value / self.low) / math.log(self.high / self.low)

    def ticks(self):
        decades = range(math.floor(math.log10(self.low)), math.ceil(math.log10(self.high)) + 1)
        steps = (1,) if math.log10(self.high / self.low) > 2.5 else self.STEPS
        return [s * 10.0 ** d for d in decades for s in steps if self.low * (1 - 1e-9) <= s * 10.0 ** d <= self.high * (1 + 1e-9)]


def label(value):
    for size, letter in ((1e6, "M"), (1e3, "k")):
        if value >= size:
            return f"{value / size:g}{letter}"
    return f"{value:g}"


def svg(title, x_name, y_name, lines):
    """lines: name -> [(x, y)], all above 0."""
    points = [p for line in lines.values() for p in line]
    x = Axis([p[0] for p in points], LEFT, WIDTH - RIGHT)
    y = Axis([p[1] for p in points], HEIGHT - BOTTOM, TOP)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}" '
           'font-family="sans-serif" font-size="12">', f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#fff"/>',
           f'<text x="{LEFT}" y="20" font-size="14">{title}</text>']
    for tick in x.ticks():
        out.append(f'<path d="M{x.at(tick):.1f} {TOP}V{HEIGHT - BOTTOM}" stroke="#ddd"/>'
                   f'<text x="{x.at(tick):.1f}" y="{HEIGHT - BOTTOM + 16}" text-anchor="middle">{label(tick)}</text>')
    for tick in y.ticks():
        out.append(f'<path d="M{LEFT} {y.at(tick):.1f}H{WIDTH - RIGHT}" stroke="#ddd"/>'
                   f'<text x="{LEFT - 6}" y="{y.at(tick) + 4:.1f}" text-anchor="end">{label(tick)}</text>')
    out.append(f'<text x="{(LEFT + WIDTH - RIGHT) / 2}" y="{HEIGHT - 10}" text-anchor="middle">{x_name}</text>'
               f'<text x="{LEFT - 6}" y="{TOP - 8}" text-anchor="end">{y_name}</text>')
    labels = []
    for colour, (name, line) in zip(COLOURS, lines.items()):
        places = [(x.at(a), y.at(b)) for a, b in line]
        out.append(f'<polyline points="{" ".join(f"{a:.1f},{b:.1f}" for a, b in places)}" fill="none" stroke="{colour}" stroke-width="2"/>')
        out += [f'<circle cx="{a:.1f}" cy="{b:.1f}" r="3" fill="{colour}"/>' for a, b in places]
        at = places[-1][1] + 4
        while any(abs(at - other) < 14 for other in labels): # else one would lie over the other
            at += 14
        labels.append(at)
        out.append(f'<text x="{places[-1][0] + 8:.1f}" y="{at:.1f}" fill="{colour}">{name}</text>')
    return "\n".join(out) + "\n</svg>\n"
