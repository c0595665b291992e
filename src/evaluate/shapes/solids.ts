/**
 * A posed character as triangles with normals, in its own space with y up: the shown skin, or boxes and bones without
 * one. For thumbnails: only plain arrays, no GPU.
 */
import { transformPoint, type Vec3 } from '../../math/vec3.ts';
import type { Character } from '../../model/document.ts';
import { boneEnds } from '../../model/skeleton/bone-ends.ts';
import { BOX_FACES, boxCorner, hasBox } from '../../model/skeleton/boxes.ts';
import { jointDofCount, rootDofCount } from '../../model/skeleton/dofs.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { blendMorphs, compileSkin, deform } from '../skin/deform.ts';
import { worldOf } from './world-of.ts';

/** Triangles with normals, in the character's own space. */
export interface Solid {
  /** x y z per vertex. */
  readonly points: Float64Array;
  /** Normals of any length. */
  readonly normals: Float64Array;
  /** Three vertices each. */
  readonly triangles: ArrayLike<number>;
}

/** Skins with more vertices are not deformed for a thumbnail; their bones are drawn instead. */
const MAX_VERTICES = 150_000;

/** The parts of a character that its solids depend on. */
export type Posed = Pick<Character, 'skeleton' | 'skins' | 'shownSkin' | 'morphs' | 'clampsToLimits'>;

/**
 * A posed character as triangles.
 * @param values one per DOF of the character; missing ones are 0
 * @returns undefined if there is nothing to draw
 */
export function solidOf(character: Posed, values: ArrayLike<number>): Solid | undefined {
  const { skeleton } = character;
  const dofs = Float64Array.from(values);
  const world = skeleton && worldOf(skeleton, dofs, character.clampsToLimits);
  const skin = character.skins[character.shownSkin];
  if (skin && skin.triangles.length > 0 && skin.positions.length / 3 <= MAX_VERTICES) {
    const compiled = compileSkin(skin);
    const points = new Float64Array(3 * compiled.vertexCount);
    const normals = new Float64Array(3 * compiled.vertexCount);
    const weights = rootDofCount(skeleton) + jointDofCount(skeleton);
    const weighed = new Float64Array(weights + character.morphs.length);
    weighed.set(dofs.subarray(0, weighed.length));
    blendMorphs(compiled, character.morphs, weighed, weights, points, normals);
    deform(compiled, world, points, normals, points, normals);
    return { points, normals, triangles: skin.triangles };
  }
  return skeleton && world ? bonesOf(skeleton, world) : undefined;
}

/** Fractions of a bone's length, and of the whole character. */
const BONE_WIDTH = 0.09;
const WIDEST = 0.032;
const NARROWEST = 0.008;

function bonesOf({ joints, ...skeleton }: Skeleton, world: Float64Array): Solid {
  const made = new Solids();
  const at = (j: number, point: Vec3) => transformPoint(world, point, 16 * j);
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let j = 0; j < joints.length; j++) {
    for (let k = 0; k < 3; k++) {
      low[k] = Math.min(low[k], world[16 * j + 12 + k]);
      high[k] = Math.max(high[k], world[16 * j + 12 + k]);
    }
  }
  const size = Math.hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]) || 1;
  joints.forEach((joint, j) => {
    if (joint.parent >= 0) made.bone(at(joint.parent, [0, 0, 0]), at(j, [0, 0, 0]), size);
    if (hasBox(joint)) {
      made.box([0, 1, 2, 3, 4, 5, 6, 7].map((i) => at(j, boxCorner(joint.box, i))));
    } else made.knob(at(j, [0, 0, 0]), 0.8 * WIDEST * size);
  });
  for (const end of boneEnds({ ...skeleton, joints })) made.bone(at(end.joint, [0, 0, 0]), at(end.joint, end.at), size);
  return made.solid();
}

/** Faces don't share vertices, so that each has a uniform colour. */
class Solids {
  private readonly points: number[] = [];
  private readonly normals: number[] = [];
  private readonly triangles: number[] = [];

  solid(): Solid {
    return {
      points: Float64Array.from(this.points),
      normals: Float64Array.from(this.normals),
      triangles: this.triangles,
    };
  }

  /** Four-sided, thickest near its start. */
  bone(from: readonly number[], to: readonly number[], size: number): void {
    const along = to.map((v, k) => v - from[k]);
    const length = Math.hypot(...along);
    if (!(length > 0)) return;
    const axis = along.map((v) => v / length);
    const width = Math.max(NARROWEST * size, Math.min(WIDEST * size, BONE_WIDTH * length));
    // Any direction perpendicular to it.
    const least = axis.map(Math.abs).indexOf(Math.min(...axis.map(Math.abs)));
    const side = cross(
      axis,
      [0, 1, 2].map((k) => (k === least ? 1 : 0)),
    );
    const scale = 1 / (Math.hypot(...side) || 1);
    const u = side.map((v) => v * scale);
    const v = cross(axis, u);
    const ring = [u, v, u.map((x) => -x), v.map((x) => -x)].map((d) =>
      from.map((x, k) => x + 0.18 * along[k] + width * d[k]),
    );
    ring.forEach((corner, i) => {
      const next = ring[(i + 1) % 4];
      this.face([from, next, corner]);
      this.face([corner, next, to]);
    });
  }

  knob(at: readonly number[], radius: number): void {
    const tip = (k: number, sign: number) => at.map((v, i) => (i === k ? v + sign * radius : v));
    for (let i = 0; i < 8; i++) {
      this.face([tip(0, i & 1 ? 1 : -1), tip(1, i & 2 ? 1 : -1), tip(2, i & 4 ? 1 : -1)]);
    }
  }

  /** Corners in the order of `boxCorner`. */
  box(corners: readonly (readonly number[])[]): void {
    for (const [a, b, c, d] of BOX_FACES) this.face([corners[a], corners[b], corners[c], corners[d]]);
  }

  /** A face of three or four corners; double-sided. */
  private face(corners: readonly (readonly number[])[]): void {
    const [a, b, c] = corners;
    const normal = cross(
      b.map((v, k) => v - a[k]),
      c.map((v, k) => v - a[k]),
    );
    const first = this.points.length / 3;
    for (const corner of corners) {
      this.points.push(...corner);
      this.normals.push(...normal);
    }
    this.triangles.push(first, first + 1, first + 2);
    if (corners.length > 3) this.triangles.push(first, first + 2, first + 3);
  }
}

function cross(a: readonly number[], b: readonly number[]): number[] {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}
