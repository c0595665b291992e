/**
 * Marks on a motion path, in front of everything: a dot at each whole frame, a diamond at each time with keys, and a
 * larger one under the pointer. Three draw calls, for all instances of the character.
 */
import { DynamicDrawUsage, Group, InstancedBufferAttribute } from 'three';
import type { PathTimes } from '../../evaluate/ik/path-dofs.ts';
import { NO_TRAVEL, placementMatrix } from '../../evaluate/space/placements.ts';
import { transformPoint, type Vec3 } from '../../math/vec3.ts';
import type { Character } from '../../model/document.ts';
import { dots } from '../scene/dots.ts';
import { rawColor } from '../scene/thick-lines.ts';
import type { StageTheme } from '../theme.ts';

/** CSS pixels, outline included. */
const FRAME_SIZE = 6;
const KEY_SIZE = 12;
const LIT_SIZE = 17;
/** Over the parts of the path that something covers. */
const FIRST_ORDER = 16;

type Marks = ReturnType<typeof dots>;

/** What of a path can be dragged. */
export interface PathHandles {
  /** As drawn: stepped, with a stepped preview. */
  readonly character: Character;
  readonly joint: number;
  /** Seconds of the transport; frames of samples, then keys. */
  readonly times: readonly number[];
  /** x y z for each of `times`, as drawn, in the character's space. */
  readonly places: Float64Array;
}

export class PathMarks {
  readonly object = new Group();
  handles: PathHandles | undefined;
  private readonly frames = dots(1, { size: FRAME_SIZE, depthTest: false });
  private readonly keys = dots(1, { size: KEY_SIZE, depthTest: false, diamond: true });
  private readonly lit = dots(1, { size: LIT_SIZE, depthTest: false, diamond: true });
  private litIndex: number | undefined;

  constructor() {
    for (const [i, marks] of this.all.entries()) {
      marks.matrixAutoUpdate = false;
      marks.renderOrder = FIRST_ORDER + i;
      this.object.add(marks);
    }
  }

  setTheme(theme: StageTheme): void {
    for (const { material } of this.all) {
      material.uniforms.color.value.copy(rawColor(theme.selected));
      material.uniforms.ring.value.copy(rawColor(theme.labelHalo));
    }
    for (const { material } of [this.frames, this.lit]) material.uniforms.color.value.copy(rawColor(theme.hovered));
  }

  /** @param frames x y z for each frame, in the character's space @param keys as `frames`, for each time with keys */
  show(
    character: Character,
    joint: number,
    { frames: frameTimes, keys: keyTimes, isSampled }: PathTimes,
    frames: Float64Array,
    keys: Float64Array,
  ): void {
    place(this.frames, character, frames);
    place(this.keys, character, keys);
    const places = isSampled ? Float64Array.from([...frames, ...keys]) : keys;
    this.handles = { character, joint, times: isSampled ? [...frameTimes, ...keyTimes] : keyTimes, places };
    const { litIndex } = this;
    this.litIndex = undefined;
    this.light(litIndex);
  }

  /** Returns whether that changed anything. */
  light(handle: number | undefined): boolean {
    const { lit, handles } = this;
    const index = handles && handle !== undefined && handle < handles.times.length ? handle : undefined;
    if (index === this.litIndex) return false;
    this.litIndex = index;
    if (handles && index !== undefined) {
      place(lit, handles.character, handles.places.subarray(3 * index, 3 * index + 3));
    } else lit.count = 0;
    return true;
  }

  dispose(): void {
    for (const marks of this.all) {
      marks.geometry.dispose();
      marks.material.dispose();
      marks.dispose();
    }
  }

  private get all(): readonly Marks[] {
    return [this.frames, this.keys, this.lit];
  }
}

/** One at each place, for each instance of the character. */
function place(marks: Marks, { placements, space }: Character, places: Float64Array): void {
  const count = places.length / 3;
  marks.count = count * placements.length;
  if (marks.instanceMatrix.count < marks.count) {
    // Frees the old buffer.
    marks.dispose();
    const matrices = new Float32Array(16 * marks.count);
    marks.instanceMatrix = new InstancedBufferAttribute(matrices, 16).setUsage(DynamicDrawUsage);
  }
  const matrix = new Float64Array(16);
  const { array } = marks.instanceMatrix;
  placements.forEach((placement, p) => {
    placementMatrix(placement, space, NO_TRAVEL, matrix);
    for (let i = 0; i < count; i++) {
      const own: Vec3 = [places[3 * i], places[3 * i + 1], places[3 * i + 2]];
      const o = 16 * (p * count + i);
      array.set(transformPoint(matrix, own), o + 12);
      array[o] = array[o + 15] = 1;
    }
  });
  marks.instanceMatrix.needsUpdate = true;
}
