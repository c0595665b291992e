/** The box of the selected joint: its edges, and a handle on each face. */
import { Group, Mesh } from 'three';
import { boxMatrix } from '../../evaluate/shapes/joint-shapes.ts';
import { hasBox } from '../../model/skeleton/boxes.ts';
import type { Box, Joint } from '../../model/skeleton/skeleton.ts';
import type { CameraProjection } from '../camera/camera-projection.ts';
import { lineMaterial, rawColor, segmentsGeometry } from '../scene/thick-lines.ts';
import type { StageTheme } from '../theme.ts';
import { colorDots, type Dots, disposeDots, putDot, rigDots } from './rig-dots.ts';
import { AXES } from './rig-screen.ts';

/** Boxes smaller than this on screen have no handles, as they would overlap. CSS pixels. */
const MIN_BOX = 26;
/** A handle nearer to the joint covers it, and isn't drawn; that of a long side is, since a box may begin at its joint. */
const [NEAR_JOINT, LONG_SIDE] = [12, 80];

export class BoxHandles {
  readonly object = new Group();
  /** x y of each face's handle, −x +x −y +y −z +z; NaN if it isn't drawn. */
  readonly screen = new Float64Array(12).fill(Number.NaN);
  private readonly faces: readonly Dots[] = AXES.map(() => rigDots(2, 10, 46));
  private readonly edges = new Mesh(
    segmentsGeometry(unitBoxEdges()),
    lineMaterial({ width: 1.25, opacity: 0.9 }, { depthTest: false, depthWrite: false }),
  );

  constructor() {
    this.edges.matrixAutoUpdate = false;
    this.edges.frustumCulled = false;
    this.edges.renderOrder = 42;
    this.object.add(...this.faces, this.edges);
  }

  /** @param world of the joint, in `world[o …]` */
  place(projection: CameraProjection, joint: Joint | undefined, world: Float64Array, o: number): void {
    const { screen, edges, faces } = this;
    this.hide();
    if (!joint || !hasBox(joint)) return;
    edges.visible = true;
    boxMatrix(world, o, joint.box, 0, BOX, 0);
    edges.matrix.fromArray(BOX);
    for (let f = 0; f < 6; f++) {
      facePoint(world, o, joint.box, f, AT);
      projection.toPixels(AT[0], AT[1], AT[2], screen, 2 * f);
    }
    const isLong = (axis: number, least: number) =>
      Math.hypot(screen[4 * axis + 2] - screen[4 * axis], screen[4 * axis + 3] - screen[4 * axis + 1]) >= least;
    if (!AXES.some((axis) => isLong(axis, MIN_BOX))) {
      screen.fill(Number.NaN);
      return;
    }
    projection.toPixels(world[o + 12], world[o + 13], world[o + 14], JOINT, 0);
    for (const axis of AXES) {
      const mark = faces[axis];
      const yields = !isLong(axis, LONG_SIDE);
      mark.count = 0;
      for (let f = 2 * axis; f < 2 * axis + 2; f++) {
        if (yields && Math.hypot(screen[2 * f] - JOINT[0], screen[2 * f + 1] - JOINT[1]) < NEAR_JOINT) {
          screen.fill(Number.NaN, 2 * f, 2 * f + 2);
          continue;
        }
        facePoint(world, o, joint.box, f, AT);
        putDot(mark, mark.count++, AT, 0);
      }
      mark.instanceMatrix.needsUpdate = true;
    }
  }

  hide(): void {
    this.edges.visible = false;
    for (const mark of this.faces) mark.count = 0;
    this.screen.fill(Number.NaN);
  }

  setTheme(theme: StageTheme): void {
    const colors = [theme.axisX, theme.axisY, theme.axisZ];
    for (const axis of AXES) colorDots(this.faces[axis], colors[axis], theme);
    this.edges.material.uniforms.color.value.copy(rawColor(theme.selected));
  }

  dispose(): void {
    for (const mark of this.faces) disposeDots(mark);
    this.edges.geometry.dispose();
    this.edges.material.dispose();
  }
}

/** Scratch, never escapes. */
const BOX = new Float32Array(16);
const AT = new Float64Array(3);
const JOINT = new Float64Array(2);

/** Writes the world position of a face's handle; faces −x +x −y +y −z +z. */
function facePoint(world: Float64Array, o: number, { min, max }: Box, face: number, out: Float64Array): void {
  const p = [(min[0] + max[0]) / 2, (min[1] + max[1]) / 2, (min[2] + max[2]) / 2];
  p[face >> 1] = (face & 1 ? max : min)[face >> 1];
  for (let k = 0; k < 3; k++)
    out[k] = world[o + k] * p[0] + world[o + 4 + k] * p[1] + world[o + 8 + k] * p[2] + world[o + 12 + k];
}

function unitBoxEdges(): number[] {
  const points: number[] = [];
  for (const a of [-0.5, 0.5]) {
    for (const b of [-0.5, 0.5]) points.push(-0.5, a, b, 0.5, a, b, a, -0.5, b, a, 0.5, b, a, b, -0.5, a, b, 0.5);
  }
  return points;
}
