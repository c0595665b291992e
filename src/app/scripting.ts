/**
 * The page's console API: `window.marrow`, for teachers and tests. It uses the same functions as the menus, so what a
 * script does can be undone, and what it reads is what is drawn.
 */

import type { CommandInfo } from '../edit/commands/all.ts';
import { play } from '../edit/playback.ts';
import { number } from '../edit/schema/shape.ts';
import type { Store } from '../edit/store.ts';
import { type EndSitePosition, endSitePositions } from '../evaluate/end-sites.ts';
import { resolvedSlopes } from '../evaluate/slopes.ts';
import type { ExchangeFormat } from '../export/formats.ts';
import type { GlbOptions } from '../export/glb/options.ts';
import { transformPoint } from '../math/vec3.ts';
import type { Diagnostic } from '../model/diagnostic.ts';
import { type Character, shownTake } from '../model/document.ts';
import type { LimbRow } from '../model/limbs.ts';
import { type LayerInfo, layerCode } from '../model/takes/layer-code.ts';
import type { Channel } from '../model/takes/take.ts';
import { TANGENT_KINDS, type TangentKind } from '../model/takes/tangent-kinds.ts';
import type { RestOfPage } from '../ui/shell/rest-of-page.ts';
import { type CharacterRef, resolveCharacter } from '../ui/state/joints/character-ref.ts';
import type { PictureOptions, VideoOptions } from '../ui/state/pictures.ts';
import type { MadeExchange, Uses } from '../ui/state/workbench.ts';
import type { FrameStats } from '../view/screen.ts';
import type { GivenBlob } from '../worker/protocol.ts';
import type { Opener } from './opening.ts';

/** A file to open: a browser File, or a name with its content. */
export type ScriptFile =
  | File
  | { readonly name: string; readonly content: string | ArrayBuffer | Uint8Array<ArrayBuffer> };

export interface CharacterInfo {
  readonly id: string;
  readonly name: string;
  /** Depth-first. */
  readonly joints: readonly { readonly index: number; readonly name: string; readonly parent: number }[];
  /** All DOFs as shown now: root translation, joints depth-first, morph weights. Radians. */
  readonly dofs: readonly number[];
  readonly skins: readonly string[];
  readonly morphs: readonly string[];
  readonly takes: readonly string[];
  readonly vertexCount: number;
}

export interface KeyInfo {
  readonly channel: number;
  readonly time: number;
  readonly value: number;
  readonly slopeIn: number;
  readonly slopeOut: number;
  readonly tangentIn: TangentKind;
  readonly tangentOut: TangentKind;
}

/** A pinned point. */
export interface PinInfo {
  readonly id: number;
  readonly joint: number;
  /** In the joint's space. */
  readonly point: readonly number[];
  /** As shown now, in the character's own space (without its placement). */
  readonly position: readonly number[];
  readonly weight: number;
  readonly holdsOrientation: boolean;
}

export interface MarrowApi {
  /** Opens files like one drop of all of them; returns the diagnostics. */
  open(files: Iterable<ScriptFile> | ArrayLike<ScriptFile>): Promise<readonly Diagnostic[]>;
  /** Sets the current time; may be outside the range. */
  seek(seconds: number): void;
  play(): void;
  pause(): void;
  characters(): readonly CharacterInfo[];
  /** 16 numbers per joint, column-major, in the character's own space (without its placement). */
  worldMatrices(character?: CharacterRef): number[][];
  /** Positions of the End Sites, in file order, in the character's own space. */
  endSites(character?: CharacterRef): EndSitePosition[];
  /** Pins, in the order in which they were added. */
  pins(character?: CharacterRef): PinInfo[];
  /** x y z per vertex as drawn: morphed and skinned, in the character's own space. */
  vertices(character?: CharacterRef): number[];
  /**
   * Runs a command (`pose.setDofs`, `character.place` …) or an action of the menus (`view.frameAll` …). `characterId`,
   * `timeSeconds` and `playedRange` default to the selected character, the current time and the playback range.
   * Commands on whole curves, samples, other characters' takes, pins and skeletons (`channels.…`, `samples.…`,
   * `retarget.…`, `ik.…`, `rig.…`), and actions that use them, are loaded on first use and return a promise; before
   * the menus have come, all do. Arguments are checked: `commands()` says what each command takes.
   */
  run(commandId: string, args?: Readonly<Record<string, unknown>>): Promise<void> | undefined;
  /** All commands with their arguments in words; their scripts are loaded on first use. */
  commands(): Promise<readonly CommandInfo[]>;
  /**
   * Keys of a channel of the shown take, by default the selected keys of all channels: seconds of the take, values, and
   * slopes and kinds of their tangents.
   */
  keys(channel?: number, character?: CharacterRef): KeyInfo[];
  /**
   * Position on the page, in CSS pixels, of a point of a channel in the curve editor; undefined if it isn't shown.
   * Seconds of the transport.
   */
  placeOf(channel: number, seconds: number, value: number): { readonly x: number; readonly y: number } | undefined;
  /** Position on the page, in CSS pixels, of a point in a character's own space; undefined if it isn't visible. */
  pointOnPage(
    point: readonly [number, number, number],
    character?: CharacterRef,
  ): { readonly x: number; readonly y: number } | undefined;
  /** The layers of the shown take, from the lowest up; empty without any. */
  layers(character?: CharacterRef): LayerInfo[];
  /**
   * The limbs of a character, as its file has them; of those with a goal in the shown take also the share of IK, goal
   * and space at the current time, how far the tip is from the goal, and the goal that FK's pose reaches.
   */
  limbs(character?: CharacterRef): LimbRow[];
  /** Statistics of the last frame drawn. */
  stats(): FrameStats;
  /** Labels of the next undo and redo steps; absent if there is none. */
  steps(): { readonly undo?: string; readonly redo?: string };
  /** False if there is nothing to undo. */
  undo(): boolean;
  redo(): boolean;
  /** The viewport as a PNG: by default at its size on screen, without tools. */
  picture(options?: PictureOptions): Promise<Blob | undefined>;
  /** The playback range as a video, GIF or zip of PNGs, at the frame rate of the transport if no other is given. */
  video(options?: VideoOptions): Promise<Blob | undefined>;
  /** What is shown, as a page in one file, which needs no network. */
  webPage(): Promise<Blob | undefined>;
  /** A character as GLB, with what the file has and loses; options as of `marrow convert`. */
  glb(options?: Partial<GlbOptions>, character?: CharacterRef): Promise<MadeExchange>;
  /** The same as FBX; `keys` and `body` say nothing there. */
  fbx(options?: Partial<GlbOptions>, character?: CharacterRef): Promise<MadeExchange>;
  /** The motion of a humanoid as a VRM animation. Rejects if a bone is missing. */
  vrma(options?: Partial<GlbOptions>, character?: CharacterRef): Promise<MadeExchange>;
  /** The file of that name (`wasp.skel`) as text. The writers are loaded on first use. */
  save(name: string): Promise<string>;
  /** All characters as one zip: each in its own formats, with its textures. */
  zip(): Promise<Blob>;
}

declare global {
  interface Window {
    marrow: MarrowApi;
  }
}

export function scriptingApi(
  workbench: Uses<'store' | 'actions' | 'viewport' | 'transport' | 'timeline' | 'files'>,
  opener: Opener,
  rest: RestOfPage,
): MarrowApi {
  const { store, transport, viewport } = workbench;
  const facts = (ref: CharacterRef | undefined) => {
    const found = viewport.character(resolveCharacter(store, ref).id);
    if (!found) throw new Error('The character is not shown yet.');
    return found;
  };
  const exchange = (
    format: ExchangeFormat,
    options: Partial<GlbOptions> | undefined,
    character: CharacterRef | undefined,
  ) =>
    workbench.files.makeExchange(
      { format, character: resolveCharacter(store, character), options: { keys: 'linear', body: true, ...options } },
      { signal: new AbortController().signal, onProgress: () => undefined },
    );
  return {
    async open(files) {
      const blobs = Array.from(files, given);
      return opener.open(() => blobs);
    },
    seek(seconds) {
      const timeSeconds = number.read(seconds, 'seconds');
      transport.update((now) => ({ ...now, timeSeconds, playing: false }));
    },
    play: () => transport.update(play),
    pause: () => transport.update((now) => ({ ...now, playing: false })),
    characters: () => store.document.characters.map((c) => infoOf(c, viewport.character(c.id)?.dofs)),
    worldMatrices(character) {
      const world = facts(character).worldMatrices();
      return Array.from({ length: world.length / 16 }, (_, j) => Array.from(world.subarray(16 * j, 16 * j + 16)));
    },
    endSites(character) {
      const { skeleton } = resolveCharacter(store, character);
      const { worlds, dofs } = facts(character);
      return skeleton ? endSitePositions(skeleton, worlds, dofs) : [];
    },
    pins(character) {
      const world = facts(character).worldMatrices();
      return (resolveCharacter(store, character).ik?.pins ?? []).map((pin) => ({
        ...pin,
        position: transformPoint(world, pin.point, 16 * pin.joint),
      }));
    },
    vertices: (character) => Array.from(facts(character).vertices()),
    run(id, args = {}) {
      if (rest.page) return rest.page.run(id, args);
      return rest.fetch().then((page) => page?.run(id, args));
    },
    commands: async () => (await (rest.page ?? rest.fetch()))?.commands() ?? [],
    keys: (channel, character) => keysOf(store, character, channel),
    placeOf: (channel, seconds, value) => workbench.timeline.tab?.placeOf?.(channel, seconds, value),
    pointOnPage(point, character) {
      const placement = viewport.placementOf(resolveCharacter(store, character).id, 0);
      if (!placement) return undefined;
      const place = viewport.eye.toScreen(transformPoint(placement, point));
      return { x: place.x, y: place.y };
    },
    layers: (ref) => layersOf(resolveCharacter(store, ref), transport.get().timeSeconds),
    limbs: (ref) => limbsOf(resolveCharacter(store, ref), transport.get().timeSeconds),
    stats: () => viewport.stats(),
    steps: () => ({ undo: store.undoLabel, redo: store.redoLabel }),
    undo: () => store.undo(),
    redo: () => store.redo(),
    picture: async (options) => (await workbench.files.pictures())?.picture(options),
    video: async (options) => (await workbench.files.pictures())?.video(options),
    webPage: async () => (await workbench.files.sharing())?.webPage(),
    glb: (options, character) => exchange('glb', options, character),
    fbx: (options, character) => exchange('fbx', options, character),
    vrma: (options, character) => exchange('vrma', options, character),
    save: (name) => saveByName(store, name),
    zip: () => zipOf(store),
  };
}

/** Console input is untyped: refuse anything else with a message. */
function given(file: ScriptFile): GivenBlob {
  if (typeof file?.name !== 'string' || !(file instanceof Blob || 'content' in file)) {
    throw new TypeError('Each file must be a File, or an object with a name and content.');
  }
  if (file instanceof Blob) return { path: file.webkitRelativePath || file.name, blob: file };
  return { path: file.name, blob: new Blob([file.content]) };
}

function infoOf(character: Character, dofs: Float64Array | undefined): CharacterInfo {
  const joints = character.skeleton?.joints ?? [];
  return {
    id: character.id,
    name: character.name,
    joints: joints.map(({ name, parent }, index) => ({ index, name, parent })),
    dofs: Array.from(dofs ?? character.pose),
    skins: character.skins.map((s) => s.name),
    morphs: character.morphs.map((m) => m.name),
    takes: character.takes.map((c) => c.name),
    vertexCount: (character.skins[character.shownSkin]?.positions.length ?? 0) / 3,
  };
}

function layersOf(character: Character, timeSeconds: number): LayerInfo[] {
  const take = shownTake(character);
  return take?.layers ? layerCode(take).infos(take, timeSeconds + character.timeOffsetSeconds) : [];
}

function limbsOf(character: Character, timeSeconds: number): LimbRow[] {
  return character.limbs ? layerCode(character).limbRows(character, timeSeconds) : [];
}

function keysOf(store: Store, ref: CharacterRef | undefined, index: number | undefined): KeyInfo[] {
  const character = resolveCharacter(store, ref);
  const { selection } = store;
  const channels = shownTake(character)?.channels ?? [];
  if (index === undefined) {
    const keys = selection.characterId === character.id ? (selection.keys ?? []) : [];
    return keys.flatMap(({ channel, indices }) => {
      const all = keyInfos(channels[channel], channel);
      return indices.flatMap((k) => all[k] ?? []);
    });
  }
  if (!channels[index]) throw new Error(`${character.name} has no current take with a channel ${index}.`);
  return keyInfos(channels[index], index);
}

function keyInfos(found: Channel | undefined, channel: number): KeyInfo[] {
  if (found?.kind !== 'keys') return [];
  const { times, values, tangentsIn, tangentsOut } = found;
  const slopes = resolvedSlopes(found);
  return Array.from(times, (time, k) => ({
    channel,
    time,
    value: values[k],
    slopeIn: slopes.in[k],
    slopeOut: slopes.out[k],
    tangentIn: TANGENT_KINDS[tangentsIn.kinds[k]],
    tangentOut: TANGENT_KINDS[tangentsOut.kinds[k]],
  }));
}

/** See `savedByName`. */
async function saveByName(store: Store, name: string): Promise<string> {
  const { savedByName } = await import('../files/save/by-name.ts');
  return savedByName([resolveCharacter(store, undefined), ...store.document.characters], name);
}

async function zipOf(store: Store): Promise<Blob> {
  const { zipDocument } = await import('./zip-character.ts');
  return new Blob([zipDocument(store.document).bytes], { type: 'application/zip' });
}
