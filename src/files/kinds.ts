/**
 * All kinds of files. A record holds the names of a kind, its content, and which characters can be saved in it; the
 * tables below say what opening makes of each kind of content. Readers and writers are in `readers.ts` and
 * `writers.ts`, with an entry per kind: the page's first script includes neither, since it reads in a worker and loads
 * the writers when something is saved.
 */
import { withoutUnkeyed } from '../edit/unkeyed.ts';
import { DUMP_EXTENSIONS } from '../formats/dump/extensions.ts';
import { TEXTURE_EXTENSIONS } from '../formats/texture/extensions.ts';
import { type Character, isBvh, isOfJoints, shownSkin, shownTake } from '../model/document.ts';
import type { ContentOf, FileContent, FileKind, SourceFile, WholeCharacter } from '../model/files.ts';
import { bonesObstacle } from '../model/points.ts';
import { SETS_EXTENSION } from '../model/sets.ts';
import { axisAngleObstacle, savesAsAxisAngle } from '../model/skeleton/axis-angle.ts';
import { jointDofCount } from '../model/skeleton/dofs.ts';
import { arePoints, isPoint, stretches } from '../model/skeleton/joint-types.ts';
import { withPositions } from '../model/skeleton/position-channels.ts';
import { ownChannels } from '../model/skeleton/skel-motion.ts';
import type { Skeleton } from '../model/skeleton/skeleton.ts';
import { bindingCount, type Skin, textureNames, vertexCount } from '../model/skin.ts';
import { ATTACH_EXTENSION } from '../model/takes/attach-file.ts';
import { LAYERS_EXTENSION } from '../model/takes/layers-file.ts';
import { LIMBS_EXTENSION } from '../model/takes/limbs-file.ts';
import { MARKERS_EXTENSION } from '../model/takes/markers.ts';
import { rangeOfSamples } from '../model/takes/samples.ts';
import { keysOf, type Take } from '../model/takes/take.ts';
import { type PartOrigin, withAcclaimTake, withMorph, withSkin, withTake } from './open/assemble.ts';

/** One kind of file: its names, its content, and how it is saved. */
export interface Kind {
  /** Without the dot, in lower case; the first is used for writing. */
  readonly extensions: readonly [string, ...string[]];
  /** For users: "skeleton". */
  readonly label: string;
  /** The kind of content that it is read as and written from. */
  readonly content: FileKind;
  /** Most files with these extensions are not of this kind: the system isn't asked to open them with the page. */
  readonly isRare?: true;
  /**
   * Extensions of files that hold all of a take, alone or with what is found beside them: they can be reviewed by the
   * hundred.
   */
  readonly reviewed?: readonly string[];
  /** The kind of file with the skeleton that it is read with: which one, the names of both say. */
  readonly readWith?: string;
  /**
   * JSON of ours beside a plain file, which other programs read without it: it is found by the name of that file, and
   * holds what it can't.
   */
  readonly beside?: Beside;
  /** No file of the kind is text. */
  readonly isBinary?: true;
  /** Absent if it is only read. */
  readonly save?: Saving;
}

/**
 * The plain file that JSON of ours is beside. One of a skeleton goes to the character whose skeleton has the longest
 * name that begins its own; one of a take to the take that is called like it.
 */
export type Beside = 'skeleton' | 'take';

/** How characters are saved in a kind of file, as far as menus need to know; its writer knows the rest. */
export interface Saving {
  /** In the save menu. */
  readonly label: string;
  /** Whether a character has anything to save in this kind of file. */
  has(character: Character): boolean;
  /** Why a character can't be saved in it although it has the content; a sentence. */
  obstacle?(character: Character): string | undefined;
  /** Whether its files hold the character's own parts; otherwise they are copies, and saving marks nothing as saved. */
  isOwn(character: Character): boolean;
}

/** Points have none. */
const hasBones = ({ skeleton }: Character) => skeleton !== undefined && !arePoints(skeleton);
const isAxisAngle = ({ skeleton }: Character) => skeleton !== undefined && savesAsAxisAngle(skeleton);
const isAnyones = () => true;

/** Acclaim has neither scales nor shear. */
function acclaimObstacle(character: Character): string | undefined {
  const { skeleton } = character;
  if (arePoints(skeleton)) return bonesObstacle(character);
  const joint = skeleton?.joints.find(({ motion }) => stretches(motion));
  return joint && `${joint.name || 'A joint'} scales or shears, which Acclaim can’t store.`;
}

/** All kinds of files, by the name of their format. */
export const KINDS = {
  skel: {
    extensions: ['skel'],
    label: 'skeleton',
    content: 'skel',
    save: {
      label: 'Skeleton (.skel)',
      has: hasBones,
      obstacle: bonesObstacle,
      isOwn: (c) => !hasBones(c) || (isOfJoints(c, 'skel') && !isAxisAngle(c)),
    },
  },
  // Readers recognise the axis-angle form by content, whatever the extension; saving depends on the extension.
  axskel: {
    extensions: ['axskel'],
    label: 'skeleton',
    content: 'skel',
    save: {
      label: 'Axis-angle skeleton (.axskel)',
      has: (c) => hasBones(c) && c.skeleton !== undefined && axisAngleObstacle(c.skeleton) === undefined,
      obstacle: (c) => bonesObstacle(c) ?? (c.skeleton && axisAngleObstacle(c.skeleton)),
      isOwn: (c) => !hasBones(c) || isAxisAngle(c),
    },
  },
  skin: {
    extensions: ['skin'],
    label: 'skin',
    content: 'skin',
    save: {
      label: 'Skin (.skin)',
      has: (c) => shownSkin(c) !== undefined,
      isOwn: isAnyones,
    },
  },
  morph: {
    extensions: ['morph'],
    label: 'morph',
    content: 'morph',
    save: {
      label: 'Morphs (.morph)',
      has: ({ morphs }) => morphs.length > 0,
      isOwn: isAnyones,
    },
  },
  anim: {
    extensions: ['anim'],
    label: 'animation',
    content: 'anim',
    save: {
      label: 'Animation (.anim)',
      has: (c) => shownTake(c) !== undefined && !arePoints(c.skeleton),
      obstacle: bonesObstacle,
      isOwn: (c) => !hasBones(c) || isOfJoints(c, 'skel'),
    },
  },
  rig: {
    extensions: ['rig'],
    label: 'rig',
    content: 'rig',
    save: {
      label: 'Rig (.rig)',
      has: (c) => hasBones(c) || shownSkin(c) !== undefined,
      // No part of a character: it only names the others.
      isOwn: () => false,
    },
  },
  bvh: {
    extensions: ['bvh'],
    label: 'motion capture',
    content: 'bvh',
    reviewed: ['bvh'],
    save: {
      label: 'Motion capture (.bvh)',
      has: hasBones,
      obstacle: bonesObstacle,
      isOwn: (c) => !hasBones(c) || isBvh(c),
    },
  },
  asf: {
    extensions: ['asf'],
    label: 'Acclaim skeleton',
    content: 'asf',
    save: {
      label: 'Acclaim skeleton (.asf)',
      has: hasBones,
      obstacle: acclaimObstacle,
      isOwn: (c) => !hasBones(c) || isOfJoints(c, 'asf'),
    },
  },
  amc: {
    extensions: ['amc'],
    label: 'Acclaim motion',
    content: 'amc',
    readWith: 'asf',
    reviewed: ['amc'],
    save: {
      label: 'Acclaim motion (.amc)',
      has: (c) => hasBones(c) && shownTake(c) !== undefined,
      obstacle: acclaimObstacle,
      isOwn: (c) => !hasBones(c) || isOfJoints(c, 'asf'),
    },
  },
  pose: {
    extensions: ['pose'],
    label: 'poses',
    content: 'pose',
    save: {
      label: 'Poses (.pose)',
      has: ({ poses }) => (poses?.length ?? 0) > 0,
      isOwn: isAnyones,
    },
  },
  gltf: {
    extensions: ['gltf', 'glb', 'vrm', 'vrma'],
    label: 'glTF',
    content: 'character',
    reviewed: ['glb', 'vrma'],
  },
  fbx: {
    extensions: ['fbx'],
    label: 'FBX',
    content: 'character',
    reviewed: ['fbx'],
  },
  numpy: {
    extensions: ['npz', 'npy'],
    label: 'arrays of numpy',
    content: 'character',
    reviewed: ['npz', 'npy'],
    isBinary: true,
  },
  c3d: {
    extensions: ['c3d'],
    label: 'points (C3D)',
    content: 'character',
    reviewed: ['c3d'],
    isBinary: true,
  },
  trc: {
    extensions: ['trc'],
    label: 'points',
    content: 'trc',
    reviewed: ['trc'],
    save: {
      label: 'Points (.trc)',
      has: ({ skeleton }) => arePoints(skeleton),
      isOwn: isAnyones,
    },
  },
  // Points if its columns say so, else numbers to compare as any others.
  table: {
    extensions: ['csv'],
    label: 'table',
    content: 'dump',
    isRare: true,
  },
  texture: {
    extensions: TEXTURE_EXTENSIONS,
    label: 'image',
    content: 'texture',
    isBinary: true,
  },
  markers: {
    extensions: [MARKERS_EXTENSION],
    label: 'markers',
    content: 'markers',
    isRare: true,
    beside: 'take',
    save: {
      label: 'Markers (.markers.json)',
      has: ({ takes }) => takes.some(({ markers }) => markers !== undefined),
      // They are kept with their takes.
      isOwn: () => false,
    },
  },
  sets: {
    extensions: [SETS_EXTENSION],
    label: 'sets',
    content: 'sets',
    isRare: true,
    beside: 'skeleton',
    save: {
      label: 'Selection sets and locks (.sets.json)',
      has: ({ skeleton, sets }) => skeleton !== undefined && sets !== undefined,
      isOwn: isAnyones,
    },
  },
  layers: {
    extensions: [LAYERS_EXTENSION],
    label: 'layers',
    content: 'layers',
    isRare: true,
    beside: 'take',
    save: {
      label: 'Layers (.layers.json)',
      has: (character) => shownTake(character)?.layers !== undefined,
      // They are kept with their takes.
      isOwn: () => false,
    },
  },
  limbs: {
    extensions: [LIMBS_EXTENSION],
    label: 'limbs',
    content: 'limbs',
    isRare: true,
    beside: 'skeleton',
    save: {
      label: 'Limbs (.limbs.json)',
      has: ({ limbs }) => limbs !== undefined,
      isOwn: isAnyones,
    },
  },
  attach: {
    extensions: [ATTACH_EXTENSION],
    label: 'attachments',
    content: 'attach',
    isRare: true,
    beside: 'take',
    save: {
      label: 'Attachments (.attach.json)',
      has: (character) => shownTake(character)?.attached !== undefined,
      // They are kept with their takes.
      isOwn: () => false,
    },
  },
  // Told by content; other texts with these extensions are read as dumps without numbers.
  dump: {
    extensions: DUMP_EXTENSIONS,
    label: 'dump',
    content: 'dump',
    isRare: true,
  },
} as const satisfies Readonly<Record<string, Kind>>;

/** A kind of file: `skel` is the hierarchy form of a skeleton, `axskel` the axis-angle form. */
export type FormatKind = keyof typeof KINDS;

/** A kind of file that characters can be saved in. */
export type SavedKind = {
  [K in FormatKind]: (typeof KINDS)[K] extends { readonly save: Saving } ? K : never;
}[FormatKind];

/** The content of a kind of file. */
export type HeldBy<K extends FormatKind> = ContentOf<(typeof KINDS)[K]['content']>;

/** In the order of the menus. */
export const FORMAT_KINDS = Object.keys(KINDS) as readonly FormatKind[];
/** The kinds that can be written. */
export const SAVED_KINDS = FORMAT_KINDS.filter(isSaved);

/** Whether files of a kind can be written. */
export function isSaved(kind: FormatKind): kind is SavedKind {
  const { save }: Kind = KINDS[kind];
  return save !== undefined;
}

/** Without dots. */
export const READABLE_EXTENSIONS: readonly string[] = FORMAT_KINDS.flatMap((kind) => KINDS[kind].extensions);
/** Extensions of files that can be written, without the dot, in lower case. */
export const WRITABLE_EXTENSIONS: readonly string[] = SAVED_KINDS.flatMap((kind) => KINDS[kind].extensions);

/** The kind of a file by its extension, in any case; undefined for other files. */
export function formatKindOf(fileName: string): FormatKind | undefined {
  const name = fileName.toLowerCase();
  // Kinds with a longer extension come first: `.markers.json` is no `.json`.
  return FORMAT_KINDS.find((kind) => KINDS[kind].extensions.some((own) => name.endsWith(`.${own}`)));
}

/** Extensions of the files that can be reviewed by the hundred, without the dot. */
export const REVIEWED_EXTENSIONS: readonly string[] = FORMAT_KINDS.flatMap((kind): readonly string[] => {
  const { reviewed = [] }: Kind = KINDS[kind];
  return reviewed;
});

/** Whether a file is a take that can be reviewed by the hundred, by its name or path. */
export function isReviewable(path: string): boolean {
  return REVIEWED_EXTENSIONS.some((extension) => path.toLowerCase().endsWith(`.${extension}`));
}

/** The kind of file with the skeleton that a file is read with, by its name or path; undefined if it needs none. */
export function skeletonKindFor(path: string): FormatKind | undefined {
  const { readWith }: Partial<Kind> = KINDS[formatKindOf(path) ?? 'dump'];
  return FORMAT_KINDS.find((kind) => kind === readWith);
}

/** Whether takes are read with such a file beside them, by its name or path. */
export function isBesideTakes(path: string): boolean {
  const own = formatKindOf(path);
  return own !== undefined && FORMAT_KINDS.some((kind) => (KINDS[kind] as Kind).readWith === own);
}

/** The plain file that files of a kind are beside; undefined if they are no JSON beside a plain file. */
export function besideOf(format: FormatKind): Beside | undefined {
  const { beside }: Kind = KINDS[format];
  return beside;
}

/** `wasp` of `wasp.sets.json`: the name of what such a file is beside. */
export function nameBeside(fileName: string): string {
  const format = formatKindOf(fileName);
  const name = fileName.toLowerCase();
  const extension = format && KINDS[format].extensions.find((own) => name.endsWith(`.${own}`));
  return extension === undefined ? fileName : fileName.slice(0, -extension.length - 1);
}

/** Whether a file is a buffer of glTF files, by its name or path. */
export function isBuffer(path: string): boolean {
  return path.toLowerCase().endsWith('.bin');
}

/** The result of opening the content of a file (`open/open-in-steps.ts`). */
export type Opening<C> = CharacterOpening<C> | PartOpening<C> | OtherOpening;

/** It has skeletons: each is a character. */
export interface CharacterOpening<C> {
  readonly as: 'characters';
  characters(content: C): readonly WholeCharacter[];
  /** Whether skins, morphs and animations next to it belong to it. */
  readonly takesParts: boolean;
}

/** It belongs to a character: that of its rig or of its skeleton's name, or else the selected one. */
export interface PartOpening<C> {
  readonly as: 'part';
  add(character: Character, content: C, from: PartOrigin): Character;
  /** Only for a character with a skin; the name of the skin tells which. */
  readonly onSkin?: true;
  /** It comes with its skeleton, and needs no other file once it is read: the file of that; undefined if none is known. */
  skeletonFile?(content: C): SourceFile | undefined;
  /** It belongs to a character that takes no other parts, too, if there is no other. */
  readonly onAny?: true;
  /** Why it is not used without a character, as a sentence; absent: it is one by itself and waits for a skeleton. */
  readonly unused?: string;
}

/**
 * A list of other files; JSON beside one (`Kind.beside`, `open/beside-files.ts`); poses for a library; an image for a
 * skin; numbers to compare with a character: opened by rules of their own. One more gets its rules in
 * `open/grouping.ts` and `open/open-in-steps.ts`.
 */
export interface OtherOpening {
  readonly as: 'rig' | 'poses' | 'texture' | 'dump' | 'beside' | 'layers';
}

/** The role of a file in an opening. */
export type Role = Opening<never>['as'];

const OPENINGS: { readonly [K in FileKind]: Opening<ContentOf<K>> } = {
  skel: {
    as: 'characters',
    characters: ({ skeletons }) => skeletons.map((skeleton) => bare(skeleton)),
    takesParts: true,
  },
  skin: { as: 'part', add: (character, { skin }, from) => withSkin(character, skin, from) },
  morph: {
    as: 'part',
    add: (character, { morph }, from) => withMorph(character, morph, from),
    onSkin: true,
    unused: 'No open character has a skin for it.',
  },
  anim: {
    as: 'part',
    onAny: true,
    add(character, { take }, from) {
      const { skeleton, pose } = character;
      const own = skeleton ? ownChannels(take, skeleton, pose) : take;
      return withTake(withoutUnkeyed(character), own, from);
    },
  },
  rig: { as: 'rig' },
  // Motion capture is complete in itself; skins are not made for it.
  bvh: {
    as: 'characters',
    characters: ({ captures, guessed }) =>
      captures.map(({ skeleton, take }) =>
        guessed ? { ...bare(withPositions(skeleton, guessed.positions), take), space: guessed } : bare(skeleton, take),
      ),
    takesParts: false,
  },
  asf: {
    as: 'characters',
    characters: ({ skeleton, space }) => [{ ...bare(skeleton), ...(space && { space }), clampsToLimits: false }],
    takesParts: true,
  },
  amc: {
    as: 'part',
    skeletonFile: (take) => take.of,
    add: withAcclaimTake,
  },
  trc: {
    as: 'characters',
    characters: ({ capture: { skeleton, take }, space }) => [{ ...bare(skeleton, take), ...(space && { space }) }],
    takesParts: false,
  },
  pose: { as: 'poses' },
  character: { as: 'characters', characters: ({ characters }) => characters, takesParts: false },
  texture: { as: 'texture' },
  dump: { as: 'dump' },
  markers: { as: 'beside' },
  sets: { as: 'beside' },
  limbs: { as: 'beside' },
  attach: { as: 'beside' },
  // Joined with the files that it names before anything is opened (`open/layers.ts`).
  layers: { as: 'layers' },
};

function bare(skeleton: Skeleton, take?: Take): WholeCharacter {
  return { skeleton, skins: [], morphs: [], takes: take ? [take] : [], textures: [] };
}

/** For content of that kind only, which TypeScript can't check. */
export function openingOf(kind: FileKind): Opening<FileContent> {
  return OPENINGS[kind];
}

/** Names as in JSON; values are numbers, texts or lists of them. */
export type Facts = Readonly<Record<string, unknown>>;

/** Nothing for a skin without materials. */
function materialFacts(skin: Skin): Facts {
  const materials = skin.surfaces.flatMap(({ material }) => material ?? []);
  const textures = textureNames(skin);
  return {
    ...(materials.length > 0 && { materials: materials.map(({ name }) => name) }),
    ...(textures.length > 0 && { textures }),
  };
}

/** Sentences of `marrow info` about the content of a file. */
const FACTS: { readonly [K in FileKind]: (content: ContentOf<K>) => Facts } = {
  skel: ({ skeletons }) => ({
    joints: sum(skeletons.map((s) => s.joints.length)),
    dofs: sum(skeletons.map(jointDofCount)),
    roots: skeletons.length,
    ...(skeletons[0]?.form && { form: skeletons[0].form }),
  }),
  skin: ({ skin }) => ({
    vertices: vertexCount(skin),
    triangles: skin.triangles.length / 3,
    maxAttachments: maxAttachments(skin),
    bindings: bindingCount(skin),
    texcoords: (skin.texcoords?.length ?? 0) / 2,
    ...materialFacts(skin),
  }),
  morph: ({ morph }) => ({ positions: morph.positions.indices.length, normals: morph.normals.indices.length }),
  anim: ({ take: { channels, range } }) => ({
    channels: channels.length,
    keys: sum(channels.map((c) => keysOf(c).times.length)),
    range,
  }),
  rig: ({ rig: { skeleton, skin, morphs, animation } }) => ({
    parts: [skeleton, skin, ...morphs, animation].filter((part) => part !== undefined),
  }),
  bvh({ captures }) {
    const joints = captures.flatMap(({ skeleton }) => skeleton.joints);
    // The same for all characters with samples: a row contains the channels of all roots.
    const samples = captures.find(({ take }) => take?.samples)?.take?.samples;
    const range = samples && rangeOfSamples(samples);
    return {
      joints: joints.length,
      endSites: sum(joints.map(({ endSites = [] }) => endSites.length)),
      dofs: sum(captures.map(({ skeleton }) => jointDofCount(skeleton))),
      roots: captures.length,
      frames: samples?.frameCount ?? 0,
      ...(samples && range && { frameTime: samples.frameSeconds, duration: range[1] - range[0] }),
    };
  },
  asf: ({ skeleton }) => ({
    joints: skeleton.joints.length,
    endSites: sum(skeleton.joints.map(({ endSites = [] }) => endSites.length)),
    dofs: jointDofCount(skeleton),
  }),
  amc: ({ skeleton, take }) => ({
    joints: skeleton.joints.length,
    dofs: jointDofCount(skeleton),
    ...frameFacts([take]),
  }),
  trc: ({ capture: { skeleton, take } }) => ({
    points: skeleton.joints.length,
    ...frameFacts(take ? [take] : []),
  }),
  pose: ({ poses }) => ({ poses: poses.length, names: poses.map(({ name }) => name) }),
  character: ({ characters }) => ({
    ...jointFacts(characters),
    roots: characters.length,
    vertices: sum(characters.flatMap(({ skins }) => skins.map(vertexCount))),
    morphs: sum(characters.map(({ morphs }) => morphs.length)),
    takes: characters.flatMap(({ takes }) => takes.map(({ name }) => name)),
    textures: characters.flatMap(({ textures }) => textures.map(({ name }) => name)),
    ...frameFacts(characters.flatMap(({ takes }) => takes)),
  }),
  texture: ({ texture: { mime, bytes } }) => ({ mime, bytes: bytes.length }),
  sets: ({ sets: { sets, locked } }) => ({
    sets: sets.map(({ name }) => name),
    locked: sum(locked.map(({ dofs }) => dofs.length)),
  }),
  markers: ({ markers }) => ({ markers: markers.length, labels: markers.map(({ label }) => label) }),
  layers: ({ layers: { base, layers } }) => ({
    base,
    layers: layers.map(({ name, file, mode, weight, mute, solo }) => ({
      ...{ name, file, mode, weight: typeof weight === 'number' ? weight : `${weight.times.length} keys` },
      ...{ mute, solo },
    })),
  }),
  limbs: ({ limbs: { limbs, base, goals } }) => ({
    ...(limbs && { limbs: limbs.map(({ name, joints }) => ({ name, joints })) }),
    ...(base !== undefined && { base }),
    ...(goals && { goals: goals.map(({ limb, space }) => ({ limb, space })) }),
  }),
  attach: ({ attach: { base, attached } }) => ({
    base,
    attached: attached.map(({ character, joint, span }) => ({ character, joint, span })),
  }),
  dump: ({ dump: { blocks, time: stated } }) => ({
    blocks: blocks.map(({ holds, time = stated, values, lines }) => ({
      ...(holds && { holds }),
      ...(time !== undefined && { time }),
      rows: lines.length,
      numbers: values.length,
    })),
  }),
};

/** Points are no joints. */
function jointFacts(characters: readonly WholeCharacter[]): Facts {
  const joints = characters.flatMap(({ skeleton }) => skeleton.joints);
  const points = joints.filter(({ motion }) => isPoint(motion)).length;
  return { joints: joints.length - points, ...(points > 0 && { points }) };
}

/** Of the first take that has frames; nothing if none has. */
function frameFacts(takes: readonly Take[]): Facts {
  const samples = takes.find((take) => take.samples)?.samples;
  if (!samples) return {};
  const [from, to] = rangeOfSamples(samples);
  return { frames: samples.frameCount, frameTime: samples.frameSeconds, duration: to - from };
}

/** In the order in which they are printed. */
export function factsOf(content: FileContent): Facts {
  // The entry for this content; TypeScript can't infer that from the union.
  const facts = FACTS[content.kind] as (content: FileContent) => Facts;
  return facts(content);
}

function maxAttachments({ attachments }: Skin): number {
  let most = 0;
  const start = attachments?.start ?? [];
  for (let v = 0; v + 1 < start.length; v++) most = Math.max(most, start[v + 1] - start[v]);
  return most;
}

function sum(values: readonly number[]): number {
  return values.reduce((total, value) => total + value, 0);
}
