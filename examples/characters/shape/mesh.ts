/**
 * A character's surface, assembled from parts. A part is a closed tube around some axis:
 *
 *     point(angle, v)      angle −π … π about the axis, 0 at the front;  v 0 … 1 along it
 *
 * whose texture is folded down the front and the back, u = |angle| / π: the left half and the right half share texels.
 * So tubes have no seam with duplicate vertices, half the texture suffices, and symmetry is preserved.
 *
 * Parts overlap like garments (an arm starts inside the coat). Rejected: meshing one blended volume, which hides those
 * edges, but spends as many vertices on the back as on the face, and has no texture coordinates.
 */

import { add, cross, scaled, subtract, type Vec3 } from '../../../src/math/vec3.ts';
import { type Attachments, type Material, oneSurface, type Skin } from '../../../src/model/skin.ts';
import { normalise, round } from './vectors.ts';

/** Joint indices and weights of one vertex; normalised later. */
export type Weights = ReadonlyMap<number, number>;

/** A part's rectangle in the atlas, in texels: left, top, width, height. */
export type Rect = readonly [number, number, number, number];

export interface MeshPart {
  readonly point: (angle: number, v: number) => Vec3;
  /** Radians, ascending, symmetric; the angles of the part's vertices. */
  readonly angles: readonly number[];
  /** Ascending; the rows of vertices. A pole in the first or last row is one vertex. */
  readonly rows: readonly number[];
  readonly startPole: boolean;
  readonly endPole: boolean;
  readonly rect: Rect;
  readonly weights: (p: Vec3, v: number) => Weights;
}

/** A flat grid of vertices placed on something: eyes, a mouth. */
export interface Patch {
  readonly columns: number;
  readonly rows: number;
  /** s, t in 0 … 1, t up. */
  readonly point: (s: number, t: number) => Vec3;
  readonly rect: Rect;
  readonly weights: (p: Vec3, v: number) => Weights;
}

/** First vertex and one past the last, for morphs of that part. */
export interface Span {
  readonly from: number;
  readonly to: number;
}

export class MeshBuilder {
  readonly positions: Vec3[] = [];
  private readonly texcoords: [number, number][] = [];
  private readonly weights: Weights[] = [];
  private readonly triangles: number[] = [];

  /** `atlasSize`: texels along an edge of the square texture. */
  constructor(private readonly atlasSize: number) {}

  addPart(part: MeshPart): Span {
    const from = this.positions.length;
    const columns = part.angles.length;
    const rows: number[][] = part.rows.map((v, r) => {
      const isPole = (r === 0 && part.startPole) || (r === part.rows.length - 1 && part.endPole);
      if (!isPole) return part.angles.map((angle) => this.addVertex(part, part.point(angle, v), angle, v));
      return [this.addVertex(part, part.point(0, v), Math.PI / 2, v)];
    });
    for (let r = 0; r + 1 < rows.length; r++) {
      for (let c = 0; c < columns; c++) {
        const at = (row: readonly number[], column: number) => row[row.length === 1 ? 0 : column % columns];
        const [a, b] = [at(rows[r], c), at(rows[r], c + 1)];
        const [d, e] = [at(rows[r + 1], c), at(rows[r + 1], c + 1)];
        if (a !== b) this.triangles.push(a, b, e);
        if (d !== e) this.triangles.push(a, e, d);
      }
    }
    return { from, to: this.positions.length };
  }

  addPatch(patch: Patch): Span {
    const from = this.positions.length;
    const [x, y, w, h] = patch.rect;
    for (let r = 0; r <= patch.rows; r++) {
      for (let c = 0; c <= patch.columns; c++) {
        const [s, t] = [c / patch.columns, r / patch.rows];
        this.push(patch.point(s, t), x + s * w, y + (1 - t) * h, patch.weights(patch.point(s, t), t));
      }
    }
    const wide = patch.columns + 1;
    for (let r = 0; r < patch.rows; r++) {
      for (let c = 0; c < patch.columns; c++) {
        const a = from + r * wide + c;
        this.triangles.push(a, a + 1, a + wide + 1, a, a + wide + 1, a + wide);
      }
    }
    return { from, to: this.positions.length };
  }

  private addVertex(part: MeshPart, p: Vec3, angle: number, v: number): number {
    const [x, y, w, h] = part.rect;
    return this.push(p, x + (Math.abs(angle) / Math.PI) * w, y + (1 - v) * h, part.weights(p, v));
  }

  private push(p: Vec3, texelX: number, texelY: number, weights: Weights): number {
    this.texcoords.push([texelX / this.atlasSize, 1 - texelY / this.atlasSize]);
    this.weights.push(weights);
    return this.positions.push(p) - 1;
  }

  /** Smooth normals, area-weighted, for these positions (the mesh's own, or a morph's). */
  normalsOf(positions: readonly Vec3[]): Vec3[] {
    const sums: Vec3[] = positions.map(() => [0, 0, 0]);
    for (let t = 0; t < this.triangles.length; t += 3) {
      const [a, b, c] = this.triangles.slice(t, t + 3);
      const n = cross(subtract(positions[b], positions[a]), subtract(positions[c], positions[a]));
      for (const v of [a, b, c]) sums[v] = add(sums[v], n);
    }
    return sums.map((n) => normalise(n));
  }

  /**
   * The skin, rounded for the file: positions and texture coordinates to 3 decimals, normals to 2, weights to 2 with a
   * sum of exactly 1. `bindings` are world matrices in the binding pose.
   */
  skin(name: string, bindings: Float64Array, material?: Material): Skin {
    const positions = this.positions.map((p) => roundVec(p, 3));
    const triangles = Uint32Array.from(this.triangles);
    return {
      name,
      positions: Float64Array.from(positions.flat()),
      normals: Float64Array.from(this.normalsOf(this.positions).flatMap((n) => roundVec(n, 2))),
      ...(material && {
        texcoords: Float64Array.from(this.texcoords.flatMap((t) => t.map((x) => round(x, 3)))),
      }),
      attachments: packWeights(this.weights),
      triangles,
      surfaces: oneSurface(triangles, material),
      bindings: bindings.map((x) => round(x, 5)),
    };
  }
}

export const roundVec = (p: Vec3, decimals: number): [number, number, number] => [
  round(p[0], decimals),
  round(p[1], decimals),
  round(p[2], decimals),
];

/** Smaller weights are left out: they have no visible effect, but take room in the file. */
const MIN_WEIGHT = 0.03;

/** At most 4 per vertex, in hundredths that sum to 100; the rounding error is added to the largest. */
function packWeights(all: readonly Weights[]): Attachments {
  const start = [0];
  const joints: number[] = [];
  const weights: number[] = [];
  for (const vertex of all) {
    const total = [...vertex.values()].reduce((s, w) => s + w, 0);
    const ranked = [...vertex].sort((a, b) => b[1] - a[1]).filter(([, w]) => w >= MIN_WEIGHT * total);
    const kept = ranked.slice(0, 4);
    const sum = kept.reduce((s, [, w]) => s + w, 0);
    const parts = kept.map(([joint, w]) => ({ joint, hundredths: Math.round((100 * w) / sum) }));
    parts[0].hundredths += 100 - parts.reduce((s, p) => s + p.hundredths, 0);
    for (const { joint, hundredths } of parts) {
      if (hundredths <= 0) continue;
      joints.push(joint);
      weights.push(hundredths / 100);
    }
    start.push(joints.length);
  }
  return { start: Uint32Array.from(start), joints: Uint32Array.from(joints), weights: Float64Array.from(weights) };
}

/** One cross-section of a loft: an ellipse about `at` with half axes `side` and `front`. */
export interface Section {
  readonly at: Vec3;
  readonly side: Vec3;
  readonly front: Vec3;
  /** 2 is an ellipse, larger values a rounded rectangle. */
  readonly squareness?: number;
}

/** A tube through sections, evenly spaced in v, Catmull-Rom between them. */
export function loft(sections: readonly Section[]): (angle: number, v: number) => Vec3 {
  const last = sections.length - 1;
  return (angle, v) => {
    const x = Math.max(0, Math.min(1, v)) * last;
    const i = Math.min(last - 1, Math.floor(x));
    const t = x - i;
    const four = [i - 1, i, i + 1, i + 2].map((k) => sections[Math.max(0, Math.min(last, k))]);
    const weights = catmullRom(t);
    const blend = (pick: (s: Section) => Vec3): Vec3 =>
      four.reduce<Vec3>((sum, s, k) => add(sum, scaled(pick(s), weights[k])), [0, 0, 0]);
    const power = 2 / four.reduce((sum, s, k) => sum + (s.squareness ?? 2) * weights[k], 0);
    const [sine, cosine] = [Math.sin(angle), Math.cos(angle)];
    const along = (c: number) => Math.sign(c) * Math.abs(c) ** power;
    return add(
      blend((s) => s.at),
      add(
        scaled(
          blend((s) => s.side),
          along(sine),
        ),
        scaled(
          blend((s) => s.front),
          along(cosine),
        ),
      ),
    );
  };
}

function catmullRom(t: number): readonly number[] {
  const [t2, t3] = [t * t, t * t * t];
  return [(-t3 + 2 * t2 - t) / 2, (3 * t3 - 5 * t2 + 2) / 2, (-3 * t3 + 4 * t2 + t) / 2, (t3 - t2) / 2];
}

/** `count` angles from −π, evenly spaced; `crowding` > 0 makes them denser at the front. */
export function around(count: number, crowding = 0): number[] {
  return Array.from({ length: count }, (_, i) => {
    const a = -Math.PI + (2 * Math.PI * i) / count;
    return a - crowding * Math.sin(a);
  });
}

/** `count` + 1 values from 0 to 1. */
export function along(count: number): number[] {
  return Array.from({ length: count + 1 }, (_, i) => i / count);
}
