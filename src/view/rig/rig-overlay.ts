/**
 * What rig mode draws over everything: the skeleton with a handle at each joint, arrows at the selected one and handles
 * on the faces of its box, and the joint that a click would add. It shows where things are and says where it drew them
 * (`screen`); what is taken hold of, and what becomes of it, is the tool's.
 */
import {
  type BufferGeometry,
  Group,
  InstancedBufferAttribute,
  type InstancedMesh,
  Mesh,
  type OrthographicCamera,
  type PerspectiveCamera,
  type ShaderMaterial,
} from 'three';
import type { Vec3 } from '../../math/vec3.ts';
import { hasBox } from '../../model/boxes.ts';
import type { Box, Skeleton } from '../../model/skeleton.ts';
import { dots } from '../dots.ts';
import { type Nodes, nodesFor } from '../drawn-skeletons.ts';
import { boxMatrix, sphereMatrix } from '../joint-shapes.ts';
import { placeNodes } from '../node-matrices.ts';
import type { Overlay } from '../overlay.ts';
import type { StageTheme } from '../theme.ts';
import { lineMaterial, rawColor, segmentsGeometry } from '../thick-lines.ts';
import { BoneShapes } from './bone-shapes.ts';
import { MoveArrows } from './move-arrows.ts';
import { AXES, Projection, type RigPart, type RigScreen, samePart } from './rig-screen.ts';

/** What is to be seen. */
export interface RigPicture {
  readonly skeleton: Skeleton;
  /** 16 a joint, in the character's space, as they stand now. */
  world(): Float64Array | undefined;
  /** From the character's space to the world. */
  placement(): Float64Array | undefined;
  readonly selected: number | undefined;
  /** Along which the arrows point: those of the parent's space, or the world's. */
  readonly axes: 'parent' | 'world';
  readonly withArrows: boolean;
}

type Dots = InstancedMesh<BufferGeometry, ShaderMaterial>;

/** A box that is smaller than this on the screen has no handles: they would be one upon the other. CSS pixels. */
const LEAST_BOX = 26;

const WORLD_AXES = Float64Array.of(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);

export class RigOverlay implements Overlay {
  readonly object = new Group();
  private readonly bones: BoneShapes;
  private joints = dots(1, { size: 9, depthTest: false });
  /** The selected one, the one under the pointer, and the one that a click would add. */
  private readonly selected = dots(1, { size: 12, depthTest: false });
  private readonly hot = dots(1, { size: 14, depthTest: false });
  private readonly ghost = dots(1, { size: 14, depthTest: false, hollow: true });
  private readonly ghostBone = new Mesh(
    segmentsGeometry([0, 0, 0, 0, 1, 0]),
    lineMaterial({ width: 1.5, opacity: 0.8 }, { depthTest: false, depthWrite: false }),
  );
  private readonly faces: readonly Dots[] = AXES.map(() => dots(2, { size: 10, depthTest: false }));
  private readonly boxEdges = new Mesh(
    segmentsGeometry(unitBoxEdges()),
    lineMaterial({ width: 1.25, opacity: 0.9 }, { depthTest: false, depthWrite: false }),
  );
  private readonly arrows = new MoveArrows();
  private readonly projection = new Projection();
  private readonly facesScreen = new Float64Array(12).fill(Number.NaN);
  private picture: RigPicture | undefined;
  private under: RigPart | undefined;
  private adds: { readonly from: number; readonly at: Vec3 } | undefined;
  private world = new Float64Array(0);
  private nodes = new Float64Array(0);
  private starts = new Int32Array(0);
  private theme: StageTheme | undefined;

  constructor() {
    this.bones = new BoneShapes(this.object);
    const marks = [this.joints, this.selected, this.hot, this.ghost, ...this.faces];
    for (const mark of marks) mark.matrixAutoUpdate = false;
    for (const mesh of [this.boxEdges, this.ghostBone]) {
      mesh.matrixAutoUpdate = false;
      mesh.frustumCulled = false;
      mesh.renderOrder = 42;
    }
    this.joints.renderOrder = 45;
    for (const mark of this.faces) mark.renderOrder = 46;
    this.selected.renderOrder = 47;
    this.hot.renderOrder = 48;
    this.ghost.renderOrder = 49;
    this.object.add(...marks, this.boxEdges, this.ghostBone, this.arrows.object);
    this.hideAll();
  }

  /** After an edit, or another selection; undefined: there is nothing to be rigged. */
  show(picture: RigPicture | undefined): void {
    this.picture = picture;
    if (!picture) {
      this.hideAll();
      return;
    }
    const { count, jointCount, owners } = nodesFor(picture.skeleton);
    if (this.world.length !== 16 * count) {
      this.world = new Float64Array(16 * count);
      this.nodes = new Float64Array(2 * count);
      this.starts = new Int32Array(count);
    }
    const { joints } = picture.skeleton;
    for (let n = 0; n < count; n++) this.starts[n] = n < jointCount ? joints[n].parent : owners[n - jointCount];
    this.bones.resize(count);
    this.growJoints(count);
    this.paint();
  }

  /** Lights up what is under the pointer. Whether that changed anything. */
  light(part: RigPart | undefined): boolean {
    if (samePart(part, this.under)) return false;
    this.under = part;
    this.arrows.light(part?.kind === 'arrow' ? part.axis : undefined);
    this.paint();
    return true;
  }

  /** Where a click would add a joint to one; undefined: nowhere. In the world. */
  showGhost(adds: { readonly from: number; readonly at: Vec3 } | undefined): void {
    this.adds = adds;
  }

  /** As last drawn; undefined where nothing is. */
  get screen(): RigScreen | undefined {
    const { picture, nodes, starts, arrows, facesScreen } = this;
    if (!picture || !this.object.visible) return undefined;
    const jointCount = picture.skeleton.joints.length;
    return { jointCount, nodes, starts, selected: picture.selected, arrows: arrows.screen, faces: facesScreen };
  }

  update(camera: PerspectiveCamera | OrthographicCamera, heightPx: number): void {
    const { picture, world, projection } = this;
    const from = picture?.world();
    const placement = picture?.placement();
    this.object.visible = picture !== undefined && from !== undefined && placement !== undefined;
    if (!picture || !from || !placement) return;
    const nodes = nodesFor(picture.skeleton);
    // Another document may be in the making: its matrices come with its picture.
    if (from.length < 16 * nodes.jointCount) {
      this.object.visible = false;
      return;
    }
    projection.set(camera, heightPx);
    placeNodes(nodes, placement, 0, from, world);
    this.placeBones(nodes);
    this.placeMarks(picture, nodes);
    this.placeBox(picture);
    const { selected, axes, withArrows } = picture;
    const isMarked = selected !== undefined && selected < nodes.jointCount;
    if (!isMarked || !withArrows) this.arrows.hide();
    else {
      const parent = picture.skeleton.joints[selected].parent;
      if (axes === 'world') this.arrows.place(projection, world, 16 * selected, WORLD_AXES, 0);
      else if (parent < 0) this.arrows.place(projection, world, 16 * selected, placement, 0);
      else this.arrows.place(projection, world, 16 * selected, world, 16 * parent);
    }
    this.placeGhost(nodes);
  }

  setTheme(theme: StageTheme): void {
    this.theme = theme;
    this.bones.setTheme(theme);
    this.arrows.setTheme(theme);
    const colors = [theme.axisX, theme.axisY, theme.axisZ];
    const marks: readonly (readonly [Dots, string])[] = [
      [this.joints, theme.bone],
      [this.selected, theme.selected],
      [this.hot, theme.hovered],
      [this.ghost, theme.selected],
      ...AXES.map((axis) => [this.faces[axis], colors[axis]] as const),
    ];
    for (const [mark, color] of marks) {
      mark.material.uniforms.color.value.copy(rawColor(color));
      mark.material.uniforms.ring.value.copy(rawColor(theme.labelHalo));
    }
    for (const mesh of [this.boxEdges, this.ghostBone])
      mesh.material.uniforms.color.value.copy(rawColor(theme.selected));
    this.paint();
  }

  dispose(): void {
    this.bones.dispose();
    this.arrows.dispose();
    for (const mark of [this.joints, this.selected, this.hot, this.ghost, ...this.faces]) disposeDots(mark);
    for (const mesh of [this.boxEdges, this.ghostBone]) {
      mesh.geometry.dispose();
      mesh.material.dispose();
    }
  }

  private placeBones({ count }: Nodes): void {
    const { world, bones, starts, projection, nodes } = this;
    for (let n = 0; n < count; n++) {
      const o = 16 * n + 12;
      projection.toPixels(world[o], world[o + 1], world[o + 2], nodes, 2 * n);
      if (starts[n] < 0) bones.hide(n);
      else bones.place(n, world, starts[n], n, projection.unitsPerPixel(world[o], world[o + 1], world[o + 2]));
    }
    bones.filled();
  }

  private placeMarks({ selected }: RigPicture, { count, jointCount }: Nodes): void {
    const { world, under } = this;
    for (let n = 0; n < count; n++) putDot(this.joints, n, world, 16 * n + 12);
    this.joints.count = jointCount;
    this.joints.instanceMatrix.needsUpdate = true;
    const markOne = (mark: Dots, joint: number | undefined) => {
      mark.count = joint !== undefined && joint < jointCount ? 1 : 0;
      if (joint !== undefined && mark.count) putDot(mark, 0, world, 16 * joint + 12);
      mark.instanceMatrix.needsUpdate = true;
    };
    markOne(this.selected, selected);
    markOne(this.hot, under?.kind === 'joint' ? under.joint : undefined);
  }

  private placeBox({ skeleton, selected }: RigPicture): void {
    const { world, projection, facesScreen, boxEdges } = this;
    const joint = selected === undefined ? undefined : skeleton.joints[selected];
    const isDrawn = joint !== undefined && selected !== undefined && hasBox(joint);
    boxEdges.visible = isDrawn;
    for (const mark of this.faces) mark.count = 0;
    facesScreen.fill(Number.NaN);
    if (!isDrawn) return;
    boxMatrix(world, 16 * selected, joint.box, 0, BOX, 0);
    boxEdges.matrix.fromArray(BOX);
    const at = new Float64Array(3);
    for (let f = 0; f < 6; f++) {
      facePoint(world, 16 * selected, joint.box, f, at);
      projection.toPixels(at[0], at[1], at[2], facesScreen, 2 * f);
    }
    const isTiny = AXES.every((axis) => {
      const [x, y] = [4 * axis, 4 * axis + 1];
      return !(Math.hypot(facesScreen[x + 2] - facesScreen[x], facesScreen[y + 2] - facesScreen[y]) >= LEAST_BOX);
    });
    if (isTiny) {
      facesScreen.fill(Number.NaN);
      return;
    }
    for (let f = 0; f < 6; f++) {
      facePoint(world, 16 * selected, joint.box, f, at);
      const mark = this.faces[f >> 1];
      putDot(mark, f & 1, at, 0);
      mark.count = 2;
      mark.instanceMatrix.needsUpdate = true;
    }
  }

  private placeGhost({ jointCount }: Nodes): void {
    const { adds, ghost, ghostBone, world } = this;
    ghost.count = adds ? 1 : 0;
    ghostBone.visible = adds !== undefined && adds.from >= 0 && adds.from < jointCount;
    if (!adds) return;
    putDot(ghost, 0, adds.at, 0);
    ghost.instanceMatrix.needsUpdate = true;
    if (!ghostBone.visible) return;
    const o = 16 * adds.from + 12;
    const [x, y, z] = [world[o], world[o + 1], world[o + 2]];
    const [dx, dy, dz] = [adds.at[0] - x, adds.at[1] - y, adds.at[2] - z];
    // The segment lies along y: only that column counts.
    ghostBone.matrix.set(1, dx, 0, x, 0, dy, 0, y, 0, dz, 1, z, 0, 0, 0, 1);
  }

  private paint(): void {
    const { picture, under, bones, starts, theme } = this;
    if (!picture || !theme) return;
    for (let n = 0; n < starts.length; n++) {
      const owner = starts[n];
      const isHot = under?.kind === 'bone' && under.joint === owner;
      bones.paint(n, owner === picture.selected ? 'selected' : isHot ? 'hot' : 'usual');
    }
    bones.painted();
  }

  private growJoints(count: number): void {
    const { joints } = this;
    if (count <= joints.instanceMatrix.count) return;
    joints.instanceMatrix = new InstancedBufferAttribute(new Float32Array(16 * count), 16);
  }

  private hideAll(): void {
    this.object.visible = false;
    this.arrows.hide();
    this.facesScreen.fill(Number.NaN);
  }
}

/** Scratch, never escapes. */
const BOX = new Float32Array(16);

/** Writes where the handle of a face is, −x +x −y +y −z +z, in the world. */
function facePoint(world: Float64Array, o: number, { min, max }: Box, face: number, out: Float64Array): void {
  const p = [(min[0] + max[0]) / 2, (min[1] + max[1]) / 2, (min[2] + max[2]) / 2];
  p[face >> 1] = (face & 1 ? max : min)[face >> 1];
  for (let k = 0; k < 3; k++)
    out[k] = world[o + k] * p[0] + world[o + 4 + k] * p[1] + world[o + 8 + k] * p[2] + world[o + 12 + k];
}

function putDot(mark: Dots, i: number, at: ArrayLike<number>, o: number): void {
  // Made as a Float32Array, here and by three.js; its type says any array.
  sphereMatrix(at[o], at[o + 1], at[o + 2], 1, mark.instanceMatrix.array as Float32Array, 16 * i);
}

function disposeDots(mark: Dots): void {
  mark.geometry.dispose();
  mark.material.dispose();
  mark.dispose();
}

function unitBoxEdges(): number[] {
  const points: number[] = [];
  for (const a of [-0.5, 0.5]) {
    for (const b of [-0.5, 0.5]) points.push(-0.5, a, b, 0.5, a, b, a, -0.5, b, a, 0.5, b, a, b, -0.5, a, b, 0.5);
  }
  return points;
}
