/** What the walker's parts are made with: their rectangles of the texture, their joints, sections and tubes. */
import { cross, scaled, subtract, type Vec3 } from '../../../src/math/vec3.ts';
import { along, type MeshPart, type Rect, type Section, type Weights } from '../shape/mesh.ts';
import { jointIndex, posedFrames } from '../shape/skeletons.ts';
import { normalise } from '../shape/vectors.ts';
import type { Bend } from '../shape/weights.ts';
import { WALKER_SKELETON } from './skeleton.ts';

export const ATLAS_SIZE = 512;

/** Rectangle of each part's texture, in texels from the upper left. Left and right limbs share theirs. */
export const RECTS = {
  head: [4, 4, 236, 216],
  torso: [248, 4, 150, 150],
  pack: [406, 4, 100, 100],
  arm: [248, 162, 100, 110],
  leg: [356, 162, 70, 110],
  foot: [434, 112, 72, 120],
  tail: [4, 228, 110, 160],
  scarf: [122, 228, 118, 50],
  scarfTail: [122, 286, 60, 90],
  bedroll: [190, 286, 60, 80],
  ear: [258, 280, 80, 80],
  tuft: [346, 280, 40, 40],
  eye: [394, 280, 64, 64],
  nose: [466, 240, 40, 32],
  mouth: [466, 280, 40, 40],
  thumb: [346, 328, 40, 32],
} as const satisfies Record<string, Rect>;

export type PartName = keyof typeof RECTS;

export const joint = (name: string) => jointIndex(WALKER_SKELETON, name);
export const frames = posedFrames(WALKER_SKELETON);
export const at = (name: string): Vec3 => frames[joint(name)].at;
export const only = (name: string): Weights => new Map([[joint(name), 1]]);
export const bend = (name: string, from: number, soft: number): Bend => ({ joint: joint(name), from, soft });

/** A horizontal elliptic section. */
export const level = (y: number, side: number, front: number, z = 0, squareness = 2): Section => ({
  at: [0, y, z],
  side: [side, 0, 0],
  front: [0, 0, front],
  squareness,
});

/** Rows at a loft's sections, each halved `finer` times. */
export const rowsOf = (sections: readonly Section[], finer = 1) => along((sections.length - 1) * finer);

export type WalkerShape = Omit<MeshPart, 'rect'> & { readonly name: PartName };

/** A tube along a curve in a plane x = constant, `front` up or back in that plane. */
export function bentTube(points: readonly Vec3[], sizes: readonly (readonly [number, number])[]): Section[] {
  return points.map((p, i) => {
    const tangent = normalise(subtract(points[Math.min(points.length - 1, i + 1)], points[Math.max(0, i - 1)]));
    const side: Vec3 = [1, 0, 0];
    const front = normalise(cross(side, tangent));
    return { at: p, side: scaled(side, sizes[i][0]), front: scaled(front, sizes[i][1]) };
  });
}
