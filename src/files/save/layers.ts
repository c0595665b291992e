/**
 * The files of a take with layers: its base, its layers, the plain file with the flattened result, and, last, the JSON
 * that says with which bytes of the plain file it was saved.
 */
import { type FlattenOptions, flattened as flattenedTake } from '../../edit/layers/flatten.ts';
import { writeAnim } from '../../formats/anim/write.ts';
import { sha256 } from '../../formats/sha256.ts';
import { type Diagnostic, withoutPlace } from '../../model/diagnostic.ts';
import { type Character, EMPTY_DOCUMENT, isOfJoints } from '../../model/document.ts';
import type { FileContent, ParsedFile } from '../../model/files.ts';
import { skelChannels, skelSkeleton } from '../../model/skeleton/skel-motion.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { motionOf, unlayered } from '../../model/takes/layers.ts';
import type { LayersFile } from '../../model/takes/layers-file.ts';
import { LAYERS_EXTENSION } from '../../model/takes/layers-file.ts';
import { baseOf, type Motion, restChannel, type Take } from '../../model/takes/take.ts';
import { openFiles } from '../open/open-files.ts';
import type { Copy } from './copies.ts';
import { distinctNames } from './distinct-names.ts';

/** All files of the shown take, if it has layers. */
export function layersCopies(character: Character): readonly Copy[] {
  return character.takes.flatMap((take) => (take.layers ? filesOf(character, take) : []));
}

/** All files of a take with layers but the plain one, in the order in which they are written. */
export function besidePlain(character: Character, take: Take): readonly Copy[] {
  const plain = plainName(character, take);
  return take.layers ? filesOf(character, take).filter(({ name }) => name !== plain) : [];
}

/** The take as other programs read it: without layers, moving the same; with what was lost on the way. */
export function plainTake(
  { skeleton }: Pick<Character, 'skeleton'>,
  take: Take,
  file: string,
  options: FlattenOptions = {},
): { readonly take: Take; readonly diagnostics: readonly Diagnostic[] } {
  const { take: plain, bakedCount } = flattenedTake(take, skeleton, options);
  if (bakedCount === 0) return { take: plain, diagnostics: [] };
  const what = bakedCount === 1 ? '1 channel repeats' : `${bakedCount} channels repeat`;
  const message = `${what} in a way that no sum of layers does.`;
  return {
    take: plain,
    diagnostics: [withoutPlace('info', 'extrapolation-baked', message, file, 'wrote repetitions as keys')],
  };
}

/** Files with plain takes in place of those with layers, which other formats than their own can't hold. */
export function plainFiles(
  files: readonly ParsedFile[],
  options: FlattenOptions,
): { readonly files: readonly ParsedFile[]; readonly diagnostics: readonly Diagnostic[] } {
  const hasLayers = (take: Take | undefined) => take?.layers !== undefined;
  const isLayered = (file: ParsedFile) =>
    file.kind === 'anim'
      ? hasLayers(file.take)
      : file.kind === 'bvh' && file.captures.some(({ take }) => hasLayers(take));
  if (!files.some(isLayered)) return { files, diagnostics: [] };
  const { characters } = openFiles(EMPTY_DOCUMENT, files).document;
  const diagnostics: Diagnostic[] = [];
  const plain = (take: Take, skeleton: Skeleton | undefined, file: string) => {
    const made = plainTake({ ...(skeleton && { skeleton }) }, take, file, options);
    diagnostics.push(...made.diagnostics);
    return made.take;
  };
  const made = files.map((file): ParsedFile => {
    if (!isLayered(file)) return file;
    if (file.kind === 'bvh') {
      const captures = file.captures.map((capture) =>
        capture.take ? { ...capture, take: plain(capture.take, capture.skeleton, file.source.path) } : capture,
      );
      return { ...file, captures };
    }
    if (file.kind !== 'anim') return file;
    const { skeleton } =
      characters.find(({ parts }) => parts?.takes.some((mark) => mark.file?.source.path === file.source.path)) ?? {};
    // Of motion capture the DOFs have another order in such files.
    return { ...file, take: plain(file.take, skeleton && skelSkeleton(skeleton), file.source.path) };
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
  const { layers } = take;
  if (!layers) return [];
  const plain = plainName(character, take);
  // The base of a capture is its own file.
  const base =
    plain === undefined ? (layers.baseFile ?? `${take.name}.bvh`) : (layers.baseFile ?? `${take.name}.base.anim`);
  const json = `${take.name}.${LAYERS_EXTENSION}`;
  const wanted = layers.list.map(({ name, file }) => file ?? `${take.name}.${fileWord(name)}.anim`);
  const names = distinctNames(wanted, [base, ...(plain === undefined ? [] : [plain])]);
  const anim = (name: string, layer: number): Copy => ({
    name,
    content: () => {
      const own = unlayered(take, layer < 0 ? baseOf(take) : keysAlone(motionOf(take, layer)));
      return { kind: 'anim', take: skeleton ? skelChannels(own, skeleton, layer < 0 ? pose : []) : own };
    },
  });
  const made = plainCopy(character, take, plain);
  const { ofFlattened, others } = layers;
  const content = (): FileContent => {
    const rows = layers.list.map(({ motion: _motion, file: _file, ...row }, i) => ({ ...row, file: names[i] }));
    const file: LayersFile = {
      base,
      ...(made && {
        flattened: { file: made.name, sha256: made.sha256(), ...(ofFlattened && { others: ofFlattened }) },
      }),
      layers: rows,
      ...(others && { others }),
    };
    return { kind: 'layers', layers: file };
  };
  return [
    ...(plain === undefined ? [] : [anim(base, -1)]),
    ...names.map((name, i) => anim(name, i)),
    ...(made ? [made] : []),
    { name: json, content },
  ];
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
