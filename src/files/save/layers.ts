/**
 * The files of a take with layers, goals or attachments: its base, its layers, the plain file with the flattened
 * result, and, last, the JSON files that say with which bytes of the plain file they were saved.
 */

import { notLeading } from '../../edit/follow/leaders.ts';
import { flattened as flattenedTake } from '../../edit/layers/flatten.ts';
import type { FlattenOptions } from '../../edit/layers/flatten-options.ts';
import { solvedTake } from '../../edit/limbs/flatten-goals.ts';
import { writeAnim } from '../../formats/anim/write.ts';
import { sha256 } from '../../formats/sha256.ts';
import { partsOf } from '../../model/character-parts.ts';
import { type Diagnostic, withoutPlace } from '../../model/diagnostic.ts';
import { type Character, EMPTY_DOCUMENT, isOfJoints } from '../../model/document.ts';
import type { FileContent, ParsedFile } from '../../model/files.ts';
import { soundLimbs } from '../../model/limb-problems.ts';
import { limbsByName } from '../../model/limbs.ts';
import { newCharacter } from '../../model/new-character.ts';
import type { OtherFields } from '../../model/other-fields.ts';
import { fileNameOf, type Part } from '../../model/part.ts';
import { jointReferences } from '../../model/skeleton/joint-reference.ts';
import { skelChannels, skelSkeleton } from '../../model/skeleton/skel-motion.ts';
import { ATTACH_EXTENSION } from '../../model/takes/attach-file.ts';
import { motionOf, unlayered } from '../../model/takes/layers.ts';
import { LAYERS_EXTENSION } from '../../model/takes/layers-file.ts';
import { LIMBS_EXTENSION, type LimbsFile } from '../../model/takes/limbs-file.ts';
import { baseOf, hasControls, type Motion, restChannel, type Take } from '../../model/takes/take.ts';
import { nameBeside } from '../kinds.ts';
import { limbsAlone } from '../open/layers.ts';
import { openFiles } from '../open/open-files.ts';
import type { Copy } from './copies.ts';
import { distinctNames } from './distinct-names.ts';

/** All files of takes with layers, goals or attachments. */
export function layersCopies(character: Character): readonly Copy[] {
  return character.takes.flatMap((take) => filesOf(character, take));
}

/** All files of a take with layers, goals or attachments but the plain one, in the order of writing; none without. */
export function besidePlain(character: Character, take: Take): readonly Copy[] {
  const plain = plainName(character, take);
  return filesOf(character, take).filter(({ name }) => name !== plain);
}

/**
 * The take as other programs read it: without layers, goals and attachments, moving the same; with what was lost on the
 * way.
 */
export function plainTake(
  character: Character,
  take: Take,
  file: string,
  options: FlattenOptions = {},
): { readonly take: Take; readonly diagnostics: readonly Diagnostic[] } {
  const { take: summed, bakedCount } = flattenedTake(take, character.skeleton, options);
  const plain = solvedTake(character, summed, options);
  if (bakedCount === 0) return { take: plain, diagnostics: [] };
  const what = bakedCount === 1 ? '1 channel repeats' : `${bakedCount} channels repeat`;
  const message = `${what} in a way that no sum of layers does.`;
  return {
    take: plain,
    diagnostics: [withoutPlace('info', 'extrapolation-baked', message, file, 'wrote repetitions as keys')],
  };
}

/** Whether files beside those of takes say what moves these besides their channels and layers: goals, or attachments. */
export function haveControls(files: readonly ParsedFile[]): boolean {
  return files.some((file) => file.kind === 'attach' || (file.kind === 'limbs' && file.limbs.goals));
}

/**
 * Files with plain takes in place of those with layers, which other formats than their own can't hold.
 * @param solves also in place of those with goals of limbs or attachments, for `.anim`: other writers evaluate them
 */
export function plainFiles(
  files: readonly ParsedFile[],
  options: FlattenOptions,
  solves: boolean,
): { readonly files: readonly ParsedFile[]; readonly diagnostics: readonly Diagnostic[] } {
  const hasLayers = (take: Take | undefined) => take?.layers !== undefined;
  const isLayered = (file: ParsedFile) =>
    file.kind === 'anim'
      ? hasLayers(file.take)
      : file.kind === 'bvh' && file.captures.some(({ take }) => hasLayers(take));
  const isSolved = solves && haveControls(files);
  if (!isSolved && !files.some(isLayered)) return { files, diagnostics: [] };
  const { characters } = openFiles(EMPTY_DOCUMENT, files).document;
  const alone = notLeading(characters);
  const leading = characters.filter((one) => !alone.includes(one)).flatMap(({ sources }) => sources);
  const diagnostics: Diagnostic[] = [];
  const plain = (character: Character, take: Take, file: string) => {
    const made = plainTake(character, take, file, options);
    diagnostics.push(...made.diagnostics);
    return made.take;
  };
  const made = files.flatMap((file): readonly ParsedFile[] | ParsedFile => {
    const { path } = file.source;
    if (file.kind === 'bvh' && isLayered(file)) {
      const captures = file.captures.map((capture) =>
        capture.take
          ? { ...capture, take: plain({ ...newCharacter(path, path), skeleton: capture.skeleton }, capture.take, path) }
          : capture,
      );
      return { ...file, captures };
    }
    // They would be reached a second time.
    if (isSolved && file.kind === 'limbs') return limbsAlone(file) ?? [];
    // A leader was given for what follows it.
    if (isSolved && (file.kind === 'attach' || leading.some((source) => source.path === path))) return [];
    if (file.kind !== 'anim') return file;
    const at = (character: Character) =>
      character.parts?.takes.findIndex((mark) => mark.file?.source.path === path) ?? -1;
    const character = characters.find((one) => at(one) >= 0);
    const { goals, attached } = (isSolved && character?.takes[at(character)]) || {};
    const held = isSolved && !(goals ?? attached) ? plainBeside(files, file.take) : file.take;
    if (held !== file.take) return { ...file, take: held };
    if (!(goals ?? attached) && !isLayered(file)) return file;
    const { skeleton, ...rest } = character ?? newCharacter(path, path);
    // Of motion capture the DOFs have another order in such files.
    const own = { ...rest, ...(skeleton && { skeleton: skelSkeleton(skeleton) }) };
    return {
      ...file,
      take: plain(own, { ...file.take, ...(goals && { goals }), ...(attached && { attached }) }, path),
    };
  });
  return { files: made, diagnostics };
}

/** The take of the plain file where attachments wait for a character that they name; else the take itself. */
function plainBeside(files: readonly ParsedFile[], take: Take): Take {
  const json = files.find((file) => file.kind === 'attach' && nameBeside(file.source.name) === take.name);
  return (json?.kind === 'attach' && json.plain) || take;
}

function isCapture(character: Character): boolean {
  return isOfJoints(character, 'bvh') || isOfJoints(character, 'asf');
}

function plainName(character: Character, { name }: Take): string | undefined {
  return isCapture(character) ? undefined : `${name}.anim`;
}

function filesOf(character: Character, take: Take): readonly Copy[] {
  const { skeleton, pose } = character;
  const { layers, goals, attached } = take;
  if (!hasControls(take)) return [];
  const plain = plainName(character, take);
  // The base of a capture is its own file.
  const known = layers?.baseFile ?? goals?.baseFile ?? attached?.baseFile;
  const base = known ?? `${take.name}${plain === undefined ? '.bvh' : '.base.anim'}`;
  const wanted = (layers?.list ?? []).map(({ name, file }) => file ?? `${take.name}.${fileWord(name)}.anim`);
  const names = distinctNames(wanted, [base, ...(plain === undefined ? [] : [plain])]);
  const anim = (name: string, layer: number): Copy => ({
    name,
    content: () => {
      const own = unlayered(take, layer < 0 ? baseOf(take) : keysAlone(motionOf(take, layer)));
      return { kind: 'anim', take: skeleton ? skelChannels(own, skeleton, layer < 0 ? pose : []) : own };
    },
  });
  const made = plainCopy(character, take, plain);
  const saved = (others: OtherFields | undefined) => ({
    base,
    ...(made && { flattened: { file: made.name, sha256: made.sha256(), ...(others && { others }) } }),
  });
  const jsons: Copy[] = [];
  if (layers) {
    const content = (): FileContent => {
      const rows = layers.list.map(({ motion: _motion, file: _file, ...row }, i) => ({ ...row, file: names[i] }));
      const { ofFlattened, others } = layers;
      return { kind: 'layers', layers: { ...saved(ofFlattened), layers: rows, ...(others && { others }) } };
    };
    jsons.push({ name: `${take.name}.${LAYERS_EXTENSION}`, content });
  }
  if (goals) {
    const name = `${take.name}.${LIMBS_EXTENSION}`;
    const content = (): FileContent => {
      const { list, ofFlattened, others } = goals;
      const limbs = limbsIn(character, name);
      return { kind: 'limbs', limbs: { ...(others && { others }), ...limbs, ...saved(ofFlattened), goals: list } };
    };
    jsons.push({ name, content });
  }
  if (attached) {
    const content = (): FileContent => {
      const rows = attached.list.map(({ leaderId, joint, ...row }) => ({
        ...leaderNamed(character, leaderId, joint),
        ...row,
      }));
      const { ofFlattened, others } = attached;
      return { kind: 'attach', attach: { ...saved(ofFlattened), attached: rows, ...(others && { others }) } };
    };
    jsons.push({ name: `${take.name}.${ATTACH_EXTENSION}`, content });
  }
  return [
    ...(plain === undefined ? [] : [anim(base, -1)]),
    ...names.map((name, i) => anim(name, i)),
    ...(made ? [made] : []),
    ...jsons,
  ];
}

function leaderNamed({ leaders = [] }: Character, id: string, joint: number) {
  const leader = leaders.find((one) => one.id === id);
  return {
    character: leader?.name ?? id,
    joint: jointReferences(leader?.skeleton?.joints ?? [])[joint] ?? `#${joint}`,
  };
}

/** The content of the part of limbs. */
type LimbsOfPart = Extract<Part, { readonly kind: 'limbs' }>['content'];

/** What a character's file of limbs says, if it is called so; one with the goals of a take may have both. */
function limbsIn(character: Character, name: string): Pick<LimbsFile, 'limbs' | 'others'> {
  const part = partsOf(character).find(({ kind }) => kind === 'limbs');
  if (part?.kind !== 'limbs' || fileNameOf(part) !== name) return {};
  return limbsOfPart(part.content);
}

/** Limbs as their file has them. */
function limbsOfPart({ limbs, skeleton }: LimbsOfPart): Pick<LimbsFile, 'limbs' | 'others'> {
  const { list, others } = soundLimbs(limbs, skeleton);
  return { limbs: limbsByName(list, skeleton), ...(others && { others }) };
}

/** The file of limbs, with the goals of a take that are in it, too. */
export function limbsFile(character: Character, content: LimbsOfPart, name: string): LimbsFile {
  const withGoals = character.takes.flatMap((take) => (take.goals ? filesOf(character, take) : []));
  const both = withGoals.find((copy) => copy.name === name)?.content();
  return both?.kind === 'limbs' ? both.limbs : limbsOfPart(content);
}

/** The plain file, whose bytes the JSON names by their hash. */
interface PlainCopy extends Copy {
  sha256(): string;
}

function plainCopy(character: Character, take: Take, name: string | undefined): PlainCopy | undefined {
  if (name === undefined) return undefined;
  const { skeleton, pose } = character;
  const plain = () => {
    const own = plainTake(character, take, name).take;
    return skeleton ? skelChannels(own, skeleton, pose) : own;
  };
  return {
    name,
    content: () => ({ kind: 'anim', take: plain() }),
    sha256: () => sha256(new TextEncoder().encode(writeAnim(plain(), name).text)),
  };
}

/** A layer's name as a part of a file's name. */
function fileWord(name: string): string {
  return name.replace(/[\\/:*?"<>|.\s]+/g, '_') || 'layer';
}

/** What rests in a layer leaves its DOF alone, at whatever value, and has no key in its file. */
function keysAlone({ channels }: Motion): Motion {
  return {
    channels: channels.map((channel) => (channel.kind === 'keys' ? channel : { ...channel, ...restChannel() })),
  };
}
