/**
 * The characters of the scene, each with its view and placement matrices: which were added, removed or changed by an
 * edit, and where they are in a frame. Hidden ones are kept and posed, since their values can be read; only `visible`
 * ones are drawn, picked or framed.
 */
import { Box3, type Group, Vector3 } from 'three';
import { placementMatrix } from '../evaluate/space/placements.ts';
import { timeBetween } from '../math/time-between.ts';
import { type Character, type Document, findCharacter, shownSkin, shownTake } from '../model/document.ts';
import type { Display, Selection } from '../model/session.ts';
import type { CharacterView } from './character-view.ts';
import type { Look } from './look.ts';
import type { PickableSkin } from './picking/picking.ts';
import { nodesFor, type PosedSkeleton, sizesFor } from './skeleton/drawn-skeletons.ts';
import type { Tints } from './theme.ts';

/** A character's view, with what is drawn of it elsewhere. */
export interface ShownCharacter {
  readonly view: CharacterView;
  character: Character;
  /** 16 numbers per placement: see `placements.ts`. */
  placements: Float64Array;
  /** The character they were computed for; undefined if they change with the pose. */
  placedFor: Character | undefined;
  /** Found before it was shown, for the first framing. */
  motion?: FramedMotion | undefined;
}

/** At which times framing asks where characters are. */
export interface FramedTimes {
  readonly range: readonly [number, number];
  /** Equal intervals of the range, at whose ends it asks; less than one: only now. */
  readonly count: number;
}

/** Where a character is then; empty if nothing moves it. */
interface FramedMotion extends FramedTimes {
  readonly moments: readonly Box3[];
}

/** A view that is made before its character is in the document. */
interface PreparedView {
  readonly view: CharacterView;
  readonly motion: FramedMotion | undefined;
}

/** Times of the playback range that framing considers: of one character, and of all of them together. */
const MOMENTS = 160;
const ALL_MOMENTS = 640;
const FEWEST_MOMENTS = 16;
/** Joints that are posed for it, over all moments; beside them each pose of a character costs as much as these. */
const ALL_JOINTS = 150_000;
const PER_POSE = 20;
/** Motion enlarges the framed box to at most this multiple of its current size: farther away, no one sees it. */
const MAX_ROOM = 50;

export class ShownCharacters {
  private readonly byId = new Map<string, ShownCharacter>();
  /** Of characters that aren't in the document yet. */
  private readonly prepared = new Map<string, PreparedView>();
  /** The same as a list, since iterating it allocates nothing. */
  all: readonly ShownCharacter[] = [];
  /** Those that aren't hidden. */
  visible: readonly ShownCharacter[] = [];
  /** Bounds of everything visible, as of the last `place`. */
  readonly content = new Box3();
  private readonly box = new Box3();
  private readonly own = new Box3();
  private readonly size = new Vector3();

  /**
   * @param parent of the views' objects
   * @param create makes the view of a new character
   * @param prepare called for each whose skin isn't ready yet
   */
  constructor(
    private readonly parent: Group,
    private readonly create: (id: string) => CharacterView,
    private readonly prepare: (entry: ShownCharacter) => void,
  ) {}

  get(id: string | undefined): ShownCharacter | undefined {
    return id === undefined ? undefined : this.byId.get(id);
  }

  /** The entry if it is visible. */
  seen(id: string | undefined): ShownCharacter | undefined {
    const entry = this.get(id);
    return entry?.character.isHidden ? undefined : entry;
  }

  /**
   * Makes the view of a character that the next `show` will add: thousands at once would hold up the page.
   *
   * @param times what framing will ask, which is found, too; default: nothing
   */
  prepareView(character: Character, display: Display, timeSeconds: number, times?: FramedTimes): void {
    const { id, skeleton } = character;
    if (this.byId.has(id) || this.prepared.has(id)) return;
    const view = this.create(id);
    view.setVisible(false);
    view.show(character, display, undefined, timeSeconds);
    if (skeleton) for (const prepare of [nodesFor, sizesFor]) prepare(skeleton);
    const motion = times && motionOf(view, character, times, timeSeconds);
    this.prepared.set(id, { view, motion });
  }

  /**
   * Call after an edit.
   *
   * @param everything refresh unchanged characters too: the display, the look or the joint of the heat map has changed
   */
  show(
    document: Document,
    display: Display,
    selection: Selection,
    timeSeconds: number,
    everything: boolean,
    look?: Look,
  ): void {
    const { byId, prepared } = this;
    for (const [id, { view }] of byId) {
      if (findCharacter(document, id)) continue;
      view.dispose();
      byId.delete(id);
    }
    for (const character of document.characters) {
      let entry = byId.get(character.id);
      if (!entry) {
        const { view, motion } = prepared.get(character.id) ?? { view: this.create(character.id), motion: undefined };
        prepared.delete(character.id);
        entry = { view, character, placements: new Float64Array(0), placedFor: undefined, motion };
        byId.set(character.id, entry);
        this.parent.add(entry.view.object);
      } else if (character === entry.character && (!everything || entry.view.isDrawnAlike(display))) continue;
      entry.character = character;
      if (entry.placements.length !== 16 * character.placements.length) {
        entry.placements = new Float64Array(16 * character.placements.length);
      }
      entry.view.setVisible(!character.isHidden);
      const heatJoint = selection.characterId === character.id ? selection.joint : undefined;
      if (look?.characterId === character.id) {
        entry.motion = undefined;
        entry.view.show(character, { ...display, skin: look.skin }, look.heat ?? heatJoint, timeSeconds);
      } else if (!entry.view.isShowing(character, display, heatJoint, timeSeconds)) {
        entry.motion = undefined;
        entry.view.show(character, display, heatJoint, timeSeconds);
      }
      if (entry.view.needsPreparing) this.prepare(entry);
    }
    // Made for a document that didn't come.
    for (const { view } of prepared.values()) view.dispose();
    prepared.clear();
    this.all = [...byId.values()];
    this.visible = this.all.filter(({ character }) => !character.isHidden);
  }

  seek(timeSeconds: number): void {
    for (let i = 0; i < this.all.length; i++) this.all[i].view.seek(timeSeconds);
  }

  /** The visible skins, to be picked: not those that a look draws as bones. */
  pickableSkins(look?: Look): PickableSkin[] {
    return this.visible.flatMap(({ view, character }) =>
      look?.bones && look.characterId === character.id
        ? []
        : view.skinnedMeshes.map((mesh, placement) => ({ characterId: character.id, placement, mesh })),
    );
  }

  /** The visible skeletons, to be drawn. */
  posedSkeletons(tints: Tints, look?: Look): PosedSkeleton[] {
    const posed: PosedSkeleton[] = [];
    for (const { view, character, placements } of this.visible) {
      if (!character.skeleton) continue;
      const { id, name, skeleton } = character;
      const hasSkin = shownSkin(character) !== undefined;
      const world = view.worldMatrices;
      posed.push({
        characterId: id,
        name,
        skeleton,
        world,
        dofs: view.dofs,
        placements,
        hasSkin,
        ...(hasSkin && { skinShape: view }),
        tint: tints.get(id),
        withBones: look?.characterId === id && look.bones,
      });
    }
    return posed;
  }

  /** Call every frame in which something moved: computes placement matrices and the bounds of everything. */
  place(inPlace: boolean): void {
    const { content, box, visible } = this;
    content.makeEmpty();
    for (let i = 0; i < visible.length; i++) {
      const entry = visible[i];
      const { view, character, placements } = entry;
      if (inPlace || entry.placedFor !== character) {
        const travel = view.travel(inPlace);
        for (let p = 0; p < character.placements.length; p++) {
          placementMatrix(character.placements[p], character.space, travel, placements, 16 * p);
        }
        entry.placedFor = inPlace ? undefined : character;
      }
      content.union(view.bounds(box));
    }
  }

  /**
   * Bounds of everything, or of `these`, at times of the playback range, so that the whole path of a walk is in frame.
   * One that leaves for kilometres, or jumps there by a broken frame, would be too small to see: it counts where it is
   * now.
   */
  boundsOfMotion(range: readonly [number, number], timeSeconds: number, these = this.visible): Box3[] {
    const { own, size } = this;
    const all: Box3[] = [];
    const times = framedTimes(
      range,
      these.map(({ character }) => character),
    );
    for (const entry of these) {
      const { view, character, motion: found } = entry;
      const now = view.bounds(new Box3());
      const isFound = found?.range[0] === range[0] && found.range[1] === range[1] && found.count === times.count;
      const { moments } = isFound ? found : motionOf(view, character, times, timeSeconds);
      entry.motion = undefined;
      own.copy(now);
      for (const moment of moments) own.union(moment);
      const isFar = own.getSize(size).length() > MAX_ROOM * now.getSize(size).length();
      all.push(now, ...(isFar ? [] : moments));
    }
    return all;
  }

  dispose(): void {
    for (const { view } of this.all) view.dispose();
    for (const { view } of this.prepared.values()) view.dispose();
    this.prepared.clear();
    this.byId.clear();
    this.all = this.visible = [];
  }
}

/** When framing these together asks where they are. */
export function framedTimes(range: readonly [number, number], these: readonly Character[]): FramedTimes {
  const wanted = Math.max(FEWEST_MOMENTS, Math.min(MOMENTS, ALL_MOMENTS / these.length));
  const cost = these.reduce((sum, { skeleton }) => sum + PER_POSE + (skeleton?.joints.length ?? 0), 0);
  return { range, count: Math.floor(Math.min(wanted, ALL_JOINTS / cost)) };
}

/** Leaves the view posed at `timeSeconds`. */
function motionOf(view: CharacterView, character: Character, times: FramedTimes, timeSeconds: number): FramedMotion {
  const [start, end] = times.range;
  const moments: Box3[] = [];
  if (end > start && times.count >= 1 && (character.driver || shownTake(character))) {
    for (let i = 0; i <= times.count; i++) {
      view.seek(timeBetween(start, end, i / times.count));
      moments.push(view.bounds(new Box3()));
    }
    view.seek(timeSeconds);
  }
  return { ...times, moments };
}

/** World position of a skin's vertex as drawn; false if there is none. */
export function vertexPosition(
  { view, character, placements }: ShownCharacter,
  vertex: number,
  placement: number,
  out: Vector3,
): boolean {
  const mesh = view.skinnedMeshes[placement];
  const skin = shownSkin(character);
  if (!mesh || !skin || vertex >= skin.positions.length / 3) return false;
  mesh.getVertexPosition(vertex, out);
  const m = placements;
  const o = 16 * placement;
  const { x, y, z } = out;
  out.set(
    m[o] * x + m[o + 4] * y + m[o + 8] * z + m[o + 12],
    m[o + 1] * x + m[o + 5] * y + m[o + 9] * z + m[o + 13],
    m[o + 2] * x + m[o + 6] * y + m[o + 10] * z + m[o + 14],
  );
  return true;
}
