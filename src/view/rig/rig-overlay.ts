/**
 * What rig mode draws over everything: the skeleton with a handle at each joint, arrows at the selected one, handles on
 * the faces of its box, and a preview of the joint that a click would add. It draws and reports screen positions
 * (`screen`); input is the tool's.
 */
import { Group, InstancedBufferAttribute, type OrthographicCamera, type PerspectiveCamera } from 'three';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { CameraProjection } from '../camera/camera-projection.ts';
import type { Overlay } from '../overlay.ts';
import { haveSameJoints, type Nodes, nodesFor, posedNodes } from '../skeleton/drawn-skeletons.ts';
import { placeNodes } from '../skeleton/node-matrices.ts';
import type { StageTheme } from '../theme.ts';
import { BoneShapes } from './bone-shapes.ts';
import { BoxHandles } from './box-handles.ts';
import { type AddedJoint, GhostJoint } from './ghost-joint.ts';
import { MoveArrows } from './move-arrows.ts';
import { colorDots, type Dots, disposeDots, putDot, rigDots } from './rig-dots.ts';
import { type RigPart, type RigScreen, samePart } from './rig-screen.ts';

/** What to draw. */
export interface RigPicture {
  readonly skeleton: Skeleton;
  /** 16 numbers per joint, in the character's space, as posed now. */
  world(): Float64Array | undefined;
  /** All DOFs of the character, as posed now. */
  dofs(): Float64Array | undefined;
  /** From the character's space to the world. */
  placement(): Float64Array | undefined;
  /** The active joint. */
  readonly selected: number | undefined;
  /** Selected besides. */
  readonly others: readonly number[];
  /** Space of the arrows' directions: the parent's or the world's. */
  readonly axes: 'parent' | 'world';
  readonly withArrows: boolean;
}

const WORLD_AXES = Float64Array.of(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);

export class RigOverlay implements Overlay {
  readonly object = new Group();
  private readonly bones: BoneShapes;
  private readonly joints = rigDots(1, 9, 45);
  /** The active joint, the others that are selected, and the hovered one. */
  private readonly selected = rigDots(1, 12, 47);
  private readonly others = rigDots(1, 11, 46);
  private readonly hot = rigDots(1, 14, 48);
  private readonly ghost = new GhostJoint();
  private readonly box = new BoxHandles();
  private readonly arrows = new MoveArrows();
  private readonly projection = new CameraProjection();
  private picture: RigPicture | undefined;
  private under: RigPart | undefined;
  private adds: AddedJoint | undefined;
  private world = new Float64Array(0);
  private nodes = new Float64Array(0);
  private starts = new Int32Array(0);
  private theme: StageTheme | undefined;
  /** Camera of the last frame; queries before the next one use them. */
  private camera: PerspectiveCamera | OrthographicCamera | undefined;
  private heightPx = 1;
  /** The picture has changed since it was drawn. */
  private isBehind = false;

  constructor() {
    this.bones = new BoneShapes(this.object);
    const { joints, selected, others, hot, ghost, box, arrows } = this;
    this.object.add(joints, others, selected, hot, ghost.object, box.object, arrows.object);
    this.hideAll();
  }

  /** Call after an edit or a change of selection; undefined: nothing to rig. */
  show(picture: RigPicture | undefined): void {
    if (!haveSameJoints(this.picture?.skeleton, picture?.skeleton)) this.light(undefined);
    this.picture = picture;
    this.isBehind = true;
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

  /** Highlights the part under the pointer. Returns whether that changed anything. */
  light(part: RigPart | undefined): boolean {
    if (samePart(part, this.under)) return false;
    this.under = part;
    this.arrows.light(part?.kind === 'arrow' ? part.axis : undefined);
    this.paint();
    return true;
  }

  /** Preview of the joint that a click would add; undefined: none. */
  showGhost(adds: AddedJoint | undefined): void {
    this.adds = adds;
  }

  /**
   * As drawn, or as it will be after a change or a camera move, since input may be faster than frames. Undefined if
   * nothing is drawn.
   */
  get screen(): RigScreen | undefined {
    const { camera, heightPx } = this;
    if (camera && (this.projection.look(camera, heightPx) || this.isBehind)) this.update(camera, heightPx);
    const { picture, nodes, starts, arrows, box } = this;
    if (!picture || !this.object.visible) return undefined;
    const jointCount = picture.skeleton.joints.length;
    return { jointCount, nodes, starts, selected: picture.selected, arrows: arrows.screen, faces: box.screen };
  }

  update(camera: PerspectiveCamera | OrthographicCamera, heightPx: number): void {
    this.camera = camera;
    this.heightPx = heightPx;
    const { picture, world, projection } = this;
    const from = picture?.world();
    const [dofs, placement] = [picture?.dofs(), picture?.placement()];
    this.object.visible = from !== undefined && dofs !== undefined && placement !== undefined;
    if (!picture || !from || !dofs || !placement) return;
    const nodes = nodesFor(picture.skeleton);
    // Another document may be about to be shown: its matrices come with its frame.
    if (from.length < 16 * nodes.jointCount) {
      this.object.visible = false;
      return;
    }
    this.isBehind = false;
    projection.look(camera, heightPx);
    placeNodes(posedNodes(nodes, picture.skeleton, dofs), placement, 0, from, world);
    this.placeBones(nodes);
    this.placeMarks(picture, nodes);
    const { selected, axes, withArrows } = picture;
    const own = selected === undefined ? undefined : picture.skeleton.joints[selected];
    this.box.place(projection, own, world, 16 * (selected ?? 0));
    const isMarked = selected !== undefined && selected < nodes.jointCount;
    if (!isMarked || !withArrows) this.arrows.hide();
    else {
      const parent = picture.skeleton.joints[selected].parent;
      if (axes === 'world') this.arrows.place(projection, world, 16 * selected, WORLD_AXES, 0);
      else if (parent < 0) this.arrows.place(projection, world, 16 * selected, placement, 0);
      else this.arrows.place(projection, world, 16 * selected, world, 16 * parent);
    }
    this.ghost.place(this.adds, world, nodes.jointCount);
  }

  setTheme(theme: StageTheme): void {
    this.theme = theme;
    this.bones.setTheme(theme);
    this.arrows.setTheme(theme);
    this.box.setTheme(theme);
    this.ghost.setTheme(theme);
    colorDots(this.joints, theme.bone, theme);
    colorDots(this.selected, theme.selected, theme);
    colorDots(this.others, theme.selectedToo, theme);
    colorDots(this.hot, theme.hovered, theme);
    this.paint();
  }

  dispose(): void {
    this.bones.dispose();
    this.arrows.dispose();
    this.box.dispose();
    this.ghost.dispose();
    for (const mark of [this.joints, this.others, this.selected, this.hot]) disposeDots(mark);
  }

  private placeBones({ count }: Nodes): void {
    const { world, bones, starts, projection, nodes } = this;
    for (let n = 0; n < count; n++) {
      const o = 16 * n + 12;
      projection.toPixels(world[o], world[o + 1], world[o + 2], nodes, 2 * n);
      if (starts[n] < 0) bones.hide(n);
      else bones.place(n, world, starts[n], n, projection.unitsPerPixelAt(world[o], world[o + 1], world[o + 2]));
    }
    bones.filled();
  }

  private placeMarks({ selected, others }: RigPicture, { count, jointCount }: Nodes): void {
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
    if (this.others.instanceMatrix.count < others.length) {
      this.others.instanceMatrix = new InstancedBufferAttribute(new Float32Array(16 * others.length), 16);
    }
    this.others.count = 0;
    for (let i = 0; i < others.length; i++) {
      if (others[i] < jointCount) putDot(this.others, this.others.count++, world, 16 * others[i] + 12);
    }
    this.others.instanceMatrix.needsUpdate = true;
    markOne(this.hot, under?.kind === 'joint' ? under.joint : undefined);
  }

  private paint(): void {
    const { picture, under, bones, starts, theme } = this;
    if (!picture || !theme) return;
    for (let n = 0; n < starts.length; n++) {
      const owner = starts[n];
      const isHot = under?.kind === 'bone' && under.joint === owner;
      const isToo = picture.others.includes(owner);
      bones.paint(n, owner === picture.selected ? 'selected' : isHot ? 'hot' : isToo ? 'selectedToo' : 'usual');
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
    this.box.hide();
  }
}
