/** Opacity y that is drawn over a position x. */
export interface OpacityPoint {
  readonly position: number;
  readonly opacity: number;
}

interface Place {
  readonly x: number;
  readonly y: number;
  /** dx/du. */
  readonly speed: number;
}

const kMostDegree = 3;
/** Halvings alone would need 53 to the last bit of u; Newton's steps make it a handful. */
const kMostSteps = 60;

/**
 * A clamped B-spline, (x(u), y(u)), read as y(x): x(u) = x is solved for u. The twin of
 * renderer/data/opacity_curve.h, which says more and has uniform knots alone.
 */
export class OpacityCurve {
  readonly #points: readonly OpacityPoint[];
  readonly #degree: number;
  readonly #knots: readonly number[];

  /**
   * `points`: one at least, positions never falling; few of them lower the degree. `knots`: where
   * its parts meet, ends included, each once and rising; absent, or of another number: 0, 1, 2 ...
   */
  constructor(points: readonly OpacityPoint[], degree: number, knots?: readonly number[]) {
    this.#points = points;
    this.#degree = Math.min(degree, kMostDegree, points.length - 1);
    const uniform = Array.from({ length: this.spans + 1 }, (_, i) => i);
    this.#knots = knots?.length === uniform.length ? knots : uniform;
  }

  /** Its parts are one polynomial each; 0 where there is a single point. */
  get spans(): number {
    return this.#degree === 0 ? 0 : this.#points.length - this.#degree;
  }

  /** Where span `span` begins, and where the one before it ends. */
  joint(span: number): OpacityPoint {
    const last = this.#points.length - 1;
    const end = span <= 0 ? this.#points[0] : span >= this.spans ? this.#points[last] : undefined;
    if (end) return end;
    const { x, y } = this.#place(span, this.#knots[span] ?? span);
    return { position: x, opacity: y };
  }

  /** y at x, which lies within the span's ends. */
  at(span: number, x: number): number {
    let low = this.#knots[span] ?? span;
    let high = this.#knots[span + 1] ?? low;
    let u = 0.5 * (low + high);
    for (let step = 0; step < kMostSteps; step += 1) {
      const here = this.#place(span, u);
      if (here.x === x) return here.y;
      if (here.x < x) low = u;
      else high = u;
      const newton = u + (x - here.x) / here.speed;
      // Not so (NaN included) where the curve stands upright: then halve.
      const next = newton > low && newton < high ? newton : 0.5 * (low + high);
      if (next === u) return here.y;
      u = next;
    }
    return this.#place(span, u).y;
  }

  /** Its ends degree + 1 times, all others once. */
  #knot(i: number): number {
    return this.#knots[Math.min(this.spans, Math.max(0, i - this.#degree))] ?? 0;
  }

  #place(span: number, u: number): Place {
    const degree = this.#degree;
    const part = this.#points.slice(span, span + degree + 1);
    const x = part.map((p) => p.position);
    const y = part.map((p) => p.opacity);
    const mix = (d: number[], j: number, t: number): number => {
      const a = d[j] ?? 0;
      return a + t * ((d[j + 1] ?? 0) - a);
    };
    let speed = 0;
    for (let level = 1; level <= degree; level += 1) {
      if (level === degree) {
        const width = this.#knot(span + degree + 1) - this.#knot(span + degree);
        speed = (degree * ((x[1] ?? 0) - (x[0] ?? 0))) / width;
      }
      for (let j = 0; j <= degree - level; j += 1) {
        const low = this.#knot(span + j + level);
        const high = this.#knot(span + j + degree + 1);
        const t = (u - low) / (high - low);
        x[j] = mix(x, j, t);
        y[j] = mix(y, j, t);
      }
    }
    return { x: x[0] ?? 0, y: y[0] ?? 0, speed };
  }
}
