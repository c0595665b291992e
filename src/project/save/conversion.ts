/**
 * What the files given are in another format: `.skel` and `.anim` of motion capture, `.bvh` of any skeleton and clip.
 * Everything that comes in one file of BVH goes out as one where that can be: several roots of the same frames.
 */
import type { KeyOptions } from '../../edit/convert/keys-of-samples.ts';
import { fitOneBvh, writeBvhPieces } from '../../formats/bvh/write.ts';
import { inHierarchyForm } from '../../model/axis-angle.ts';
import { type Diagnostic, withoutPlace } from '../../model/diagnostic.ts';
import type { Character } from '../../model/document.ts';
import { type FileContent, type SourceFile, stemOf } from '../../model/files.ts';
import { formatKindOf } from '../kinds.ts';
import { animOf, bvhOf, type NamedFigure, skelOf } from './character-files.ts';
import { writeFile } from './writers.ts';

/** What there can be of any character that has a skeleton. */
export const TARGETS = ['skel', 'anim', 'bvh'] as const;
export type Target = (typeof TARGETS)[number];

export interface ConversionOptions extends KeyOptions {
  /** Of `.bvh`; absent: as each clip has it, or 30. */
  readonly framesPerSecond?: number;
}

/** A file to be written, made only when its pieces are taken. */
export interface Output {
  readonly name: string;
  pieces(): Iterable<string | Uint8Array>;
  /** Complete when the pieces have been taken. */
  diagnostics(): readonly Diagnostic[];
}

/** The file that what is called so was made from: the skeleton's, or that of a clip. */
export function sourceFor({ clips, parts }: Character, name: string): SourceFile | undefined {
  const skeleton = parts?.skeleton?.file?.source;
  if (skeleton && stemOf(skeleton) === name) return skeleton;
  return parts?.clips[clips.findIndex((clip) => clip.name === name)]?.file?.source ?? skeleton;
}

/**
 * The files that characters are as `target`: for `skel` the skeleton and its clips, for `anim` the clips alone.
 * Characters without a skeleton have none.
 */
export function outputsOf(
  characters: readonly Character[],
  target: Target,
  options: ConversionOptions = {},
): readonly Output[] {
  if (target === 'bvh') return bvhOutputs(characters, options);
  return characters.flatMap((character) => {
    const skeleton = skelOf(character);
    if (!skeleton) return [];
    const clips = character.clips.map((clip) =>
      textOutput(`${clip.name}.anim`, () => ({ kind: 'anim', clip: animOf(character, clip, options) })),
    );
    if (target === 'anim') return clips;
    // A change of the ending asks for the form that all `.skel`s have.
    const readAs = formatKindOf(character.parts?.skeleton?.file?.source.name ?? '');
    const written = readAs === 'axskel' ? inHierarchyForm(skeleton) : skeleton;
    return [textOutput(`${skeleton.name}.skel`, () => ({ kind: 'skel', skeletons: [written] })), ...clips];
  });
}

/** A clip of each character, as roots of one file where they have the same frames. */
export function bvhOutputs(characters: readonly Character[], options: ConversionOptions): readonly Output[] {
  const all = characters.map((character) => bvhOf(character, options.framesPerSecond));
  const first = all.map(([figure]) => figure);
  const isOneFile = all.length > 1 && all.every((figures) => figures.length === 1);
  if (isOneFile && sameSource(characters) && fitOneBvh(first.map(({ figure }) => figure))) {
    const [source] = characters[0].sources;
    return [bvhOutput(stemOf(source), first)];
  }
  return all.flat().map((figure) => bvhOutput(figure.name, [figure]));
}

function sameSource(characters: readonly Character[]): boolean {
  const path = characters[0]?.sources[0]?.path;
  return path !== undefined && characters.every(({ sources }) => sources.length === 1 && sources[0].path === path);
}

/** Several figures of the same frames as one file. */
export function bvhOutput(stem: string, figures: readonly NamedFigure[]): Output {
  const name = `${stem}.bvh`;
  let written: readonly Diagnostic[] = [];
  return {
    name,
    *pieces() {
      const { pieces, diagnostics } = writeBvhPieces(
        figures.map(({ figure }) => figure),
        name,
      );
      yield* pieces;
      written = diagnostics();
    },
    diagnostics: () => [
      ...figures.flatMap((figure) => figure.diagnostics.map((d) => ({ ...d, file: name }))),
      ...written,
    ],
  };
}

/** A file of any format that is written as one text. */
export function textOutput(name: string, content: () => FileContent): Output {
  let written: readonly Diagnostic[] = [];
  return {
    name,
    *pieces() {
      const result = writeFile(content(), name);
      if (!result) throw new Error(`There is no writer for ${name}.`);
      written = result.diagnostics;
      yield result.text;
    },
    diagnostics: () => written,
  };
}

/** That a file can't be made, in a sentence. */
export function refusal(code: string, message: string, file: string): Diagnostic {
  return withoutPlace('error', code, message, file);
}
