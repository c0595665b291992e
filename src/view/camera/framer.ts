/**
 * What is to be framed. Framing everything, or revealing characters, waits for the next frame: poses and sizes are
 * known by then, and several requests become one move. The selection is framed at once.
 */
import { Box3, Matrix4, Vector3 } from 'three';
import { frontOf, sideByRole } from '../../evaluate/shapes/front.ts';
import type { Selection } from '../../model/session.ts';
import { hasBox } from '../../model/skeleton/boxes.ts';
import type { PickedCopy } from '../picked-copy.ts';
import { type ShownCharacter, type ShownCharacters, vertexPosition } from '../shown-characters.ts';
import { sizesFor } from '../skeleton/drawn-skeletons.ts';
import type { SkeletonDrawing } from '../skeleton/skeleton-drawing.ts';
import type { CameraRig } from './camera.ts';
import { isWellSeen } from './well-seen.ts';

/** Around a vertex, frame this fraction of the character's size. */
const AROUND_VERTEX = 0.06;
/** Above and below characters that are followed, as a part of their height. */
const ROOM_FOR_MOTION = 0.12;

export class Framer {
  /** CSS pixels at the top of the viewport covered by overlays. */
  coveredTop = (): number => 0;
  private everything: 'no' | 'smoothly' | 'first look' = 'no';
  /** Ids of what is to be framed unless well in view. */
  private revealing: readonly string[] = [];
  private readonly box = new Box3();
  private readonly ownBox = new Box3();
  private readonly point = new Vector3();
  private readonly size = new Vector3();

  constructor(
    private readonly rig: Pick<CameraRig, 'frame' | 'frameSphere' | 'lookFirst' | 'partOfHeight' | 'camera'>,
    private readonly characters: Pick<ShownCharacters, 'seen' | 'visible' | 'content' | 'boundsOfMotion'>,
    private readonly skeletons: Pick<SkeletonDrawing, 'positionOf'>,
    private readonly picked: PickedCopy,
  ) {}

  /** Frames everything in the default view. */
  lookFirst(): void {
    this.everything = 'first look';
  }

  frameAll(): void {
    if (this.everything === 'no') this.everything = 'smoothly';
  }

  /** Frames these characters unless they are well in view. */
  reveal(characterIds: readonly string[]): void {
    this.revealing = characterIds;
  }

  /** Cancels pending framing: the camera stays where it was put. */
  leave(): void {
    this.everything = 'no';
  }

  /**
   * Frames the vertex or the joints of the picked instance, or the character with its motion; everything if that isn't
   * visible.
   */
  frameSelection(
    { characterId, joint, others = [], vertex }: Selection,
    playedRange: readonly [number, number],
    timeSeconds: number,
  ): void {
    const { rig, box, point } = this;
    const entry = this.characters.seen(characterId);
    if (!entry) {
      this.frameAll();
      return;
    }
    const { id, skeleton } = entry.character;
    const copy = this.picked.of(entry.character);
    entry.view.bounds(box);
    const size = box.isEmpty() ? 1 : box.getSize(point).length();
    if (vertex !== undefined && vertexPosition(entry, vertex, copy, point)) {
      rig.frameSphere(point, AROUND_VERTEX * size, true);
    } else if (joint !== undefined && skeleton && this.skeletons.positionOf(id, copy, joint, point)) {
      box.makeEmpty();
      for (const one of [...others, joint]) {
        if (!this.skeletons.positionOf(id, copy, one, point)) continue;
        box.union(this.ownBox.setFromCenterAndSize(point, this.size.setScalar(jointRadius(entry, copy, one))));
      }
      const radius = others.length ? 0.5 * box.getSize(this.size).length() : jointRadius(entry, copy, joint);
      rig.frameSphere(box.getCenter(point), radius, true);
    } else rig.frame(this.characters.boundsOfMotion(playedRange, timeSeconds, [entry]), this.coveredTop(), true);
  }

  /**
   * Each frame, before the camera is updated: starts the requested move.
   *
   * @param isFollowing the camera goes with the characters, which are framed as they stand, with room for their motion
   */
  settle(playedRange: readonly [number, number], timeSeconds: number, isFollowing = false): void {
    const { rig, characters } = this;
    if (this.everything !== 'no' && !characters.content.isEmpty()) {
      const motion = isFollowing ? [this.standing()] : characters.boundsOfMotion(playedRange, timeSeconds);
      if (this.everything === 'first look') rig.lookFirst(motion, this.coveredTop(), quarterFaced(characters.visible));
      else rig.frame(motion, this.coveredTop(), true);
      this.everything = 'no';
    }
    if (this.revealing.length > 0) this.bringIntoView(playedRange, timeSeconds);
  }

  /** Around the characters as they are now. */
  private standing(): Box3 {
    const box = new Box3();
    for (const { view } of this.characters.visible) box.union(view.bounds(this.ownBox));
    const { y } = box.getSize(this.size);
    return box.expandByVector(this.size.set(0, ROOM_FOR_MOTION * y, 0));
  }

  private bringIntoView(playedRange: readonly [number, number], timeSeconds: number): void {
    const { revealing, rig, characters, box } = this;
    this.revealing = [];
    const entries = characters.visible.filter(({ character }) => revealing.includes(character.id));
    box.makeEmpty();
    for (const { view } of entries) box.union(view.bounds(this.ownBox));
    if (box.isEmpty()) return;
    const motion = characters.boundsOfMotion(playedRange, timeSeconds, entries);
    this.ownBox.makeEmpty();
    for (const moment of motion) this.ownBox.union(moment);
    const coveredTop = this.coveredTop();
    if (!isWellSeen(box, this.ownBox, rig.camera, rig.partOfHeight(coveredTop))) rig.frame(motion, coveredTop, true);
  }
}

/**
 * The quarter turn from +z to where characters face in the poses of their files, by the parts of the body that these
 * state: VRM 0 faces −z. Others are taken to face +z.
 */
function quarterFaced(shown: readonly ShownCharacter[]): number {
  let x = 0;
  let z = 0;
  for (const { character, placements } of shown) {
    const { skeleton, space } = character;
    if (!skeleton) continue;
    const up = space?.up ?? 'y';
    const [across, ahead] = frontOf(skeleton, [], up, sideByRole);
    const own = up === 'z' ? new Vector3(across, -ahead, 0) : new Vector3(across, 0, up === 'y' ? ahead : -ahead);
    const length = own.length() || 1;
    own.transformDirection(new Matrix4().fromArray(placements));
    x += own.x / length;
    z += own.z / length;
  }
  const quarter = Math.PI / 2;
  return quarter * Math.round(Math.atan2(x, z) / quarter);
}

/** Radius around a joint that shows it with its neighbours, in the world. */
function jointRadius({ character, placements }: ShownCharacter, copy: number, joint: number): number {
  const { skeleton } = character;
  if (!skeleton) return 1;
  let reach = 0.06 * sizesFor(skeleton).extent;
  const own = skeleton.joints[joint];
  const { min, max } = own.box;
  if (hasBox(own)) reach = Math.max(reach, 0.6 * Math.hypot(max[0] - min[0], max[1] - min[1], max[2] - min[2]));
  for (const end of own.endSites ?? []) reach = Math.max(reach, Math.hypot(...end));
  reach = Math.max(reach, own.length ?? 0);
  for (const { parent, offset } of skeleton.joints)
    if (parent === joint) reach = Math.max(reach, Math.hypot(...offset));
  const o = 16 * copy;
  return 1.8 * reach * Math.hypot(placements[o], placements[o + 1], placements[o + 2]);
}
