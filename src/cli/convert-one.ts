/**
 * What a single file of `marrow convert IN… OUT` is written from: content of OUT's kind among the files that were read,
 * or what can be converted to it.
 */

import { CommandError } from '../edit/command-error.ts';
import { notLeading } from '../edit/follow/leaders.ts';
import { besideOf, formatKindOf, isBesideTakes, isSaved, KINDS, skeletonKindFor } from '../files/kinds.ts';
import { openFiles } from '../files/open/open-files.ts';
import type { Format } from '../files/readers.ts';
import { bvhOf, type NamedCapture, skelOf, withoutBones } from '../files/save/character-files.ts';
import { outputsOf, refusal, TARGETS, type Target } from '../files/save/conversion.ts';
import { acclaimCopies, acclaimRootsCopies, bvhCopy, type ConversionOptions } from '../files/save/copies.ts';
import { haveControls, plainFiles } from '../files/save/layers.ts';
import { type Output, outputOf } from '../files/save/output.ts';
import { copiesOf, isCopy, writeParts } from '../files/save/saving.ts';
import { unitNotKept } from '../files/save/unit-not-kept.ts';
import { fitOneBvh } from '../formats/bvh/write.ts';
import { partsOf } from '../model/character-parts.ts';
import { type Diagnostic, withoutPlace } from '../model/diagnostic.ts';
import { type Character, EMPTY_DOCUMENT } from '../model/document.ts';
import { type FileContent, type FileKind, type ParsedFile, stemOf } from '../model/files.ts';
import { bonesObstacle } from '../model/points.ts';
import { axisAngleObstacle, inAxisAngleForm, inHierarchyForm } from '../model/skeleton/axis-angle.ts';
import { arePoints } from '../model/skeleton/joint-types.ts';
import type { Skeleton } from '../model/skeleton/skeleton.ts';
import { textureNames } from '../model/skin.ts';

/** What is done to a character before it is written. */
export type Edit = (character: Character) => Character;
export type PickOptions = ConversionOptions & { readonly edit: Edit | undefined };

/** The characters of these files, edited. @throws CommandError */
function charactersOf(files: readonly ParsedFile[], { edit }: PickOptions): readonly Character[] {
  const characters = notLeading(openFiles(EMPTY_DOCUMENT, files).document.characters);
  return edit ? characters.map(edit) : characters;
}

/** What is to be written, or why nothing is. */
export type Picked =
  | {
      readonly output: Output;
      /** Written beside it, all by their own names. */
      readonly beside?: readonly Output[];
    }
  | { readonly refusal: Diagnostic };

/**
 * The content of the file `out`. What edits refuse, for which nothing may be left, is told as everything else.
 *
 * @param format of `out`, one that can be saved
 */
export function pickOrRefuse(files: readonly ParsedFile[], format: Format, out: string, options: PickOptions): Picked {
  try {
    const plain = plainFiles(files, options, format.kind === 'anim');
    return saying(pick(plain.files, format, out, options), [...plain.diagnostics, ...unitsNotKept(files, format, out)]);
  } catch (error) {
    if (!(error instanceof CommandError)) throw error;
    return { refusal: refusal('conversion-refused', error.message, out) };
  }
}

function pick(files: readonly ParsedFile[], format: Format, out: string, options: PickOptions): Picked {
  const { kind } = format;
  if (kind === 'trc') return pointsOf(files, format, out, options);
  const boneless = files.some(hasPoints) ? charactersOf(files, options).flatMap((c) => bonesObstacle(c) ?? []) : [];
  if (boneless.length > 0) return { refusal: refusal('bones-missing', boneless[0], out) };
  if (isBesideTakes(out) || skeletonKindFor(out)) return acclaimOf(files, format, out, options);
  // Where goals or attachments move a take, its frames are those of the character.
  const fitting = kind === 'bvh' && haveControls(files) ? [] : files.filter((file) => file.kind === kind);
  if (fitting.length > 1)
    return {
      refusal: tooMany(
        format,
        fitting.map((file) => file.source.path),
        out,
      ),
    };
  const [only] = fitting;
  // Another frame rate means resampling: the frames can't be copied as they are.
  if (only && !options.edit && (kind !== 'bvh' || options.framesPerSecond === undefined)) {
    const picked: Picked =
      only.kind === 'skel'
        ? skelInForm(only.skeletons, only.source.name, out)
        : { output: outputOf({ name: out, content: () => only }) };
    return saying(picked, unneeded(files, only, out));
  }
  if (kind === 'rig') return rigOf(files, out);
  const target = TARGETS.find((t) => t === kind);
  const converted = target
    ? convertedTo(target, files, format, out, options)
    : (partOf(files, format, out, options) ?? copiedTo(files, format, out, options));
  if (converted) return converted;
  return { refusal: nothingFor(files, format, out) };
}

function hasPoints(file: ParsedFile): boolean {
  if (file.kind === 'trc') return true;
  return file.kind === 'character' && file.characters.some(({ skeleton }) => arePoints(skeleton));
}

/** The points of the one character that has some. */
function pointsOf(files: readonly ParsedFile[], format: Format, out: string, options: PickOptions): Picked {
  const characters = charactersOf(files, options).filter(KINDS.trc.save.has);
  const made = characters.flatMap((character) =>
    partsOf(character).map((part) => writeParts(out, [{ character, part, pose: [] }], options)),
  );
  const [output] = made;
  if (!output) return { refusal: nothingFor(files, format, out) };
  const names = characters.map(({ name }) => name);
  return made.length > 1 ? { refusal: tooMany(format, names, out) } : { output };
}

function nothingFor(files: readonly ParsedFile[], { label }: Format, out: string): Diagnostic {
  const held = files.map((file) => file.source.path).join(', ') || 'nothing';
  return refusal('part-missing', `Expected ${label} input for ${out}, found ${held}.`, out);
}

/** Once for all characters. */
function unitsNotKept(files: readonly ParsedFile[], { kind, format }: Format, out: string): readonly Diagnostic[] {
  // Some have no lengths, and points state their unit.
  if (kind === 'rig' || kind === 'trc' || besideOf(format)) return [];
  const characters = files.flatMap((file) => (file.kind === 'character' ? file.characters : []));
  const [message] = characters.flatMap(({ space }) => unitNotKept(space ? { space: space.space } : {}) ?? []);
  return message === undefined ? [] : [withoutPlace('info', 'unit-not-kept', message, out)];
}

/** What is written from one file alone. */
function unneeded(files: readonly ParsedFile[], only: ParsedFile, out: string): readonly Diagnostic[] {
  const others = files.filter((file) => file !== only).map(({ source }) => source.path);
  if (others.length === 0) return [];
  const message = `It is written from ${only.source.path} alone; ${others.join(', ')} ${others.length === 1 ? 'is' : 'are'} not needed.`;
  return [withoutPlace('info', 'input-unneeded', message, out)];
}

function saying(picked: Picked, told: readonly Diagnostic[]): Picked {
  if (!('output' in picked) || told.length === 0) return picked;
  const { output } = picked;
  return { ...picked, output: { ...output, diagnostics: () => [...output.diagnostics(), ...told] } };
}

/** The skin or morph of a character whose file holds all of it; undefined if it holds none. */
function partOf(files: readonly ParsedFile[], format: Format, out: string, options: PickOptions): Picked | undefined {
  const { kind } = format;
  if ((kind !== 'skin' && kind !== 'morph') || !files.some((file) => file.kind === 'character')) return undefined;
  const parts = charactersOf(files, options).flatMap(({ skins, morphs }): readonly FileContent[] =>
    kind === 'skin' ? skins.map((skin) => ({ kind, skin })) : morphs.map((morph) => ({ kind, morph })),
  );
  if (parts.length === 0) return undefined;
  if (parts.length > 1) {
    const names = parts.map((part) => (part.kind === 'morph' ? part.morph.name : out));
    return { refusal: tooMany(format, names, out, ALL_OF_THEM) };
  }
  const [content] = parts;
  const output = outputOf({ name: out, content: () => content });
  const textures = content.kind === 'skin' ? textureNames(content.skin) : [];
  if (textures.length === 0) return { output };
  const message = `It names ${textures.join(', ')}, which would not be written. ${ALL_OF_THEM}`;
  return saying({ output }, [withoutPlace('info', 'texture-not-written', message, out)]);
}

const ALL_OF_THEM = '"--to rig --out DIR" writes all parts.';

/** The copy of a character that such a file holds; undefined if it holds none. */
function copiedTo(files: readonly ParsedFile[], format: Format, out: string, options: PickOptions): Picked | undefined {
  const kind = format.format;
  if (!isSaved(kind)) return undefined;
  const characters = charactersOf(files, options);
  const made = characters
    .filter((c) => KINDS[kind].save.has(c) && isCopy(c, kind))
    .flatMap((c) => copiesOf(c, kind, options));
  if (made.length <= 1) return made[0] && { output: made[0] };
  const names = made.map(({ name }) => name);
  return { refusal: tooMany(format, names, out) };
}

/** @param now what to do, as a sentence */
function tooMany({ label }: Format, names: readonly string[], out: string, now = 'Name only one.'): Diagnostic {
  const message = `Expected one ${label} for ${out}, found ${names.length} (${names.join(', ')}). ${now}`;
  return refusal('part-ambiguous', message, out);
}

/**
 * Skeletons with the joint types that the extension asks for. A `.skel` may use either; its joints are converted only
 * if the input had the other extension.
 */
function skelInForm(skeletons: readonly Skeleton[], source: string, out: string): Picked {
  if (!isAxisAngleName(out)) {
    const written = isAxisAngleName(source) ? skeletons.map(inHierarchyForm) : skeletons;
    return { output: outputOf({ name: out, content: () => ({ kind: 'skel', skeletons: written }) }) };
  }
  const why =
    skeletons.length === 1
      ? axisAngleObstacle(skeletons[0])
      : `it holds one skeleton, and there are ${skeletons.length}.`;
  if (why !== undefined) {
    const message = `${out} can't be written in axis-angle form: ${why} Use .skel instead.`;
    return { refusal: refusal('axis-angle-impossible', message, out) };
  }
  return {
    output: outputOf({ name: out, content: () => ({ kind: 'skel', skeletons: skeletons.map(inAxisAngleForm) }) }),
  };
}

function isAxisAngleName(name: string): boolean {
  return formatKindOf(name) === 'axskel';
}

/** The assembled files in that format; undefined if they hold nothing that can be converted to it. */
function convertedTo(
  target: Target,
  files: readonly ParsedFile[],
  format: Format,
  out: string,
  options: PickOptions,
): Picked | undefined {
  const characters = charactersOf(files, options).filter(({ skeleton }) => skeleton);
  if (target === 'bvh') {
    let captures: readonly NamedCapture[];
    try {
      captures = characters.flatMap((character) => bvhOf(character, options.framesPerSecond));
    } catch (error) {
      if (!(error instanceof CommandError)) throw error;
      return { refusal: refusal('conversion-refused', error.message, out) };
    }
    if (captures.length === 0) return undefined;
    if (characters.length > 1 || captures.length > 1) {
      const isOne = captures.length === characters.length && files.length === 1;
      if (!isOne || !fitOneBvh(captures.map(({ capture }) => capture))) {
        return {
          refusal: tooMany(
            format,
            captures.map(({ name }) => name),
            out,
          ),
        };
      }
    }
    return { output: outputOf(bvhCopy(`${stem(out)}.bvh`, captures)) };
  }
  // One kind only: `--to skel` writes skeletons with their takes. A `.skel` may have several roots.
  const skeletons = characters.flatMap((character) => skelOf(withoutBones(character)) ?? []);
  if (target === 'skel' && skeletons.length && (files.length === 1 || isAxisAngleName(out))) {
    return skelInForm(skeletons, files[0].source.name, out);
  }
  const made = outputsOf(characters, target, options).filter(({ name }) => formatKindOf(name) === target);
  if (made.length === 0) return undefined;
  if (made.length > 1)
    return {
      refusal: tooMany(
        format,
        made.map(({ name }) => name),
        out,
        // Takes of one file can't be named one by one.
        files.length === 1 ? `"--to ${target} --out DIR" writes each.` : undefined,
      ),
    };
  return { output: made[0] };
}

/** A skeleton with its takes, whichever of both OUT names: one needs the other. */
function acclaimOf(files: readonly ParsedFile[], format: Format, out: string, options: PickOptions): Picked {
  const characters = charactersOf(files, options).filter(({ skeleton }) => skeleton);
  const [character] = characters;
  if (!character) return { refusal: nothingFor(files, format, out) };
  const why = characters.map(KINDS.asf.save.obstacle).find((each) => each !== undefined);
  if (why !== undefined) return { refusal: refusal('conversion-refused', why, out) };
  const copies =
    characters.length === 1
      ? acclaimCopies(character, options, stem(out))
      : files.length === 1 && acclaimRootsCopies(characters, options, stem(out));
  if (!copies) {
    const names = characters.map(({ name }) => name);
    return { refusal: tooMany(format, names, out, '"--to asf --out DIR" writes each.') };
  }
  const [first, ...others] = copies.map(outputOf);
  return { output: first, beside: others };
}

function stem(name: string): string {
  return stemOf({ name, path: name, bytes: 0 });
}

/** A rig that names the given files. */
function rigOf(files: readonly ParsedFile[], out: string): Picked {
  const named = (kind: FileKind) => files.filter((file) => file.kind === kind).map((file) => file.source.name);
  const [skeletons, skins, morphs, animations] = (['skel', 'skin', 'morph', 'anim'] as const).map(named);
  const twice = [skeletons, skins, animations].find((names) => names.length > 1);
  if (twice) {
    const message = `A rig names one file of each kind, found ${twice.join(', ')}.`;
    return { refusal: refusal('part-ambiguous', message, out) };
  }
  if (skeletons.length + skins.length + morphs.length + animations.length === 0) {
    return { refusal: refusal('part-missing', 'Expected a file that a rig can name, found none.', out) };
  }
  const content: FileContent = {
    kind: 'rig',
    rig: {
      name: stem(out),
      ...(skeletons.length && { skeleton: skeletons[0] }),
      ...(skins.length && { skin: skins[0] }),
      morphs,
      ...(animations.length && { animation: animations[0] }),
    },
  };
  return { output: outputOf({ name: out, content: () => content }) };
}
