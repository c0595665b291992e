/**
 * The files of a take with layers or goals: its base, its layers, the plain file with the flattened result, and, last,
 * the JSON that says with which bytes of the plain file it was saved.
 */
import { flattened as flattenedTake } from '../../edit/layers/flatten.ts';
import type { FlattenOptions } from '../../edit/layers/flatten-options.ts';
import { withoutGoals } from '../../edit/limbs/flatten-goals.ts';
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
import { skelChannels, skelSkeleton } from '../../model/skeleton/skel-motion.ts';
import { motionOf, unlayered } from '../../model/takes/layers.ts';
import { LAYERS_EXTENSION } from '../../model/takes/layers-file.ts';
import { LIMBS_EXTENSION, type LimbsFile } from '../../model/takes/limbs-file.ts';
import { baseOf, type Motion, restChannel, type Take } from '../../model/takes/take.ts';
import { limbsAlone } from '../open/layers.ts';
import { openFiles } from '../open/open-files.ts';
import type { Copy } from './copies.ts';
import { distinctNames } from './distinct-names.ts';

/** All files of takes with layers or goals. */
export function layersCopies(character: Character): readonly Copy[] {
  return character.takes.flatMap((take) => filesOf(character, take));
}

/** All files of a take with layers or goals but the plain one, in the order in which they are written; none without. */
export function besidePlain(character: Character, take: Take): readonly Copy[] {
  const plain = plainName(character, take);
  return filesOf(character, take).filter(({ name }) => name !== plain);
}

/** The take as other programs read it: without layers and goals, moving the same; with what was lost on the way. */
export function plainTake(
  character: Character,
  take: Take,
  file: string,
  options: FlattenOptions = {},
): { readonly take: Take; readonly diagnostics: readonly Diagnostic[] } {
  const { take: summed, bakedCount } = flattenedTake(take, character.skeleton, options);
  const plain = withoutGoals(character, summed, options);
  if (bakedCount === 0) return { take: plain, diagnostics: [] };
  const what = bakedCount === 1 ? '1 channel repeats' : `${bakedCount} channels repeat`;
  const message = `${what} in a way that no sum of layers does.`;
  return {
    take: plain,
    diagnostics: [withoutPlace('info', 'extrapolation-baked', message, file, 'wrote repetitions as keys')],
  };
}

/**
 * Files with plain takes in place of those with layers, which other formats than their own can't hold.
 * @param withoutGoals also in place of those with goals of limbs, for `.anim`: other writers evaluate goals themselves
 */
export function plainFiles(
  files: readonly ParsedFile[],
  options: FlattenOptions,
  withoutGoals: boolean,
): { readonly files: readonly ParsedFile[]; readonly diagnostics: readonly Diagnostic[] } {
  const hasLayers = (take: Take | undefined) => take?.layers !== undefined;
  const isLayered = (file: ParsedFile) =>
    file.kind === 'anim'
      ? hasLayers(file.take)
      : file.kind === 'bvh' && file.captures.some(({ take }) => hasLayers(take));
  const hasGoals = withoutGoals && files.some((file) => file.kind === 'limbs' && file.limbs.goals);
  if (!hasGoals && !files.some(isLayered)) return { files, diagnostics: [] };
  const { characters } = openFiles(EMPTY_DOCUMENT, files).document;
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
    if (hasGoals && file.kind === 'limbs') return limbsAlone(file) ?? [];
    if (file.kind !== 'anim') return file;
    const at = (character: Character) =>
      character.parts?.takes.findIndex((mark) => mark.file?.source.path === path) ?? -1;
    const character = characters.find((one) => at(one) >= 0);
    const { goals } = (hasGoals && character?.takes[at(character)]) || {};
    if (!goals && !isLayered(file)) return file;
    const { skeleton, ...rest } = character ?? newCharacter(path, path);
    // Of motion capture the DOFs have another order in such files.
    const own = { ...rest, ...(skeleton && { skeleton: skelSkeleton(skeleton) }) };
    return { ...file, take: plain(own, { ...file.take, ...(goals && { goals }) }, path) };
  });
  return { files: made, diagnostics };
}

function isCapture(character: Character): boolean {
  return isOfJoints(character, 'bvh') || isOfJoints(character, 'asf');
}

function plainName(character: Character, { name }: Take): string | undefined {
  return isCapture(character) ? undefined : `${name}.anim`;
}

function filesOf(character: Character, take: Take): readonly Copy[] {
  const { skeleton, pose } = character;
  const { layers, goals } = take;
  if (!layers && !goals) return [];
  const plain = plainName(character, take);
  // The base of a capture is its own file.
  const base = layers?.baseFile ?? goals?.baseFile ?? `${take.name}${plain === undefined ? '.bvh' : '.base.anim'}`;
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
  return [
    ...(plain === undefined ? [] : [anim(base, -1)]),
    ...names.map((name, i) => anim(name, i)),
    ...(made ? [made] : []),
    ...jsons,
  ];
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
