/**
 * The motion path of one joint over the playback range: sampled when the joint, the character or the range changes, not
 * while playing.
 */
import {
  BufferGeometry,
  DynamicDrawUsage,
  InstancedBufferAttribute,
  InstancedMesh,
  type ShaderMaterial,
  Sphere,
} from 'three';
import { compileSkeleton, worldMatrices } from '../evaluate/kinematics.ts';
import { NO_TRAVEL, placementMatrix } from '../evaluate/placements.ts';
import { dofCountOf, poseAt } from '../evaluate/pose.ts';
import { carrierOf, groundTravel } from '../evaluate/travel.ts';
import { timeBetween } from '../math/time-between.ts';
import type { Character } from '../model/document.ts';
import { shownClip } from '../model/document.ts';
import type { StageTheme } from './theme.ts';
import { lineMaterial, rawColor, segmentsGeometry } from './thick-lines.ts';

/** Samples per second of the range, and at most. */
const SAMPLES_PER_SECOND = 60;
const MAX_SAMPLES = 1500;

/**
 * Positions of a joint at `count` times from `start` to `end` (seconds of the transport), x y z each, in the
 * character's space. `inPlace` subtracts the root's horizontal motion, as when drawing.
 */
export function samplePath(
  character: Character,
  joint: number,
  [start, end]: readonly [number, number],
  count: number,
  inPlace: boolean,
): Float64Array {
  const path = new Float64Array(3 * count);
  if (!character.skeleton) return path;
  const skeleton = compileSkeleton(character.skeleton);
  const dofs = new Float64Array(dofCountOf(character));
  const world = new Float64Array(16 * skeleton.jointCount);
  const travel = new Float64Array(3);
  const carrier = carrierOf(character);
  for (let i = 0; i < count; i++) {
    poseAt(character, timeBetween(start, end, i / Math.max(1, count - 1)), dofs);
    worldMatrices(skeleton, dofs, world);
    if (inPlace) groundTravel(skeleton, character.space, carrier, dofs, world, travel);
    for (let k = 0; k < 3; k++) path[3 * i + k] = world[16 * joint + 12 + k] - travel[k];
  }
  return path;
}

export class Trail {
  readonly object: InstancedMesh<BufferGeometry, ShaderMaterial>;
  private shown: { character: Character; joint: number; start: number; end: number; inPlace: boolean } | undefined;

  constructor() {
    const material = lineMaterial({ width: 1.75, opacity: 0.85, lift: 1e-5 });
    this.object = new InstancedMesh(new BufferGeometry(), material, 0);
    this.object.frustumCulled = false;
    this.object.visible = false;
    this.object.matrixAutoUpdate = false;
    this.object.renderOrder = 5;
  }

  setTheme(theme: StageTheme): void {
    this.object.material.uniforms.color.value.copy(rawColor(theme.selected));
  }

  /** Shows the joint's path, or nothing. `range` in seconds of the transport; default: the clip's own. */
  show(
    character: Character | undefined,
    joint: number | undefined,
    range: readonly [number, number] | undefined,
    inPlace: boolean,
  ): void {
    const clip = character && shownClip(character);
    const [start, end] = range ?? clip?.range ?? [0, 0];
    const has = character?.skeleton && joint !== undefined && joint < character.skeleton.joints.length && end > start;
    this.object.visible = Boolean(has);
    if (!has) {
      this.shown = undefined;
      return;
    }
    const { shown } = this;
    const same =
      shown?.character === character &&
      shown.joint === joint &&
      shown.start === start &&
      shown.end === end &&
      shown.inPlace === inPlace;
    if (same) return;
    this.shown = { character, joint, start, end, inPlace };
    const count = Math.min(MAX_SAMPLES, 2 + Math.ceil((end - start) * SAMPLES_PER_SECOND));
    const path = samplePath(character, joint, [start, end], count, inPlace);
    const segments = new Float64Array(6 * (count - 1));
    for (let i = 0; i + 1 < count; i++) segments.set(path.subarray(3 * i, 3 * i + 6), 6 * i);
    this.object.geometry.dispose();
    this.object.geometry = segmentsGeometry(segments);
    // It is never culled, and three.js would complain of paths beyond 32-bit floats.
    this.object.geometry.boundingSphere = new Sphere();
    this.place(character);
  }

  dispose(): void {
    this.object.geometry.dispose();
    this.object.material.dispose();
    this.object.dispose();
  }

  private place({ placements, space }: Character): void {
    const matrices = new Float32Array(16 * placements.length);
    const matrix = new Float64Array(16);
    placements.forEach((placement, p) => {
      placementMatrix(placement, space, NO_TRAVEL, matrix);
      matrices.set(matrix, 16 * p);
    });
    this.object.instanceMatrix = new InstancedBufferAttribute(matrices, 16).setUsage(DynamicDrawUsage);
    this.object.count = placements.length;
  }
}
