/**
 * `marrow convert IN… OUT`: writes OUT in the format of its extension, from content of that kind in IN, or from what
 * can be converted to it: `.skel` and `.anim` from motion capture, `.bvh` from any skeleton and its clip. Without a
 * `.rig` in IN, one is written that names the given files.
 *
 * `marrow convert IN… OUT.glb`: a character with its takes (`convert-glb.ts`).
 *
 * `marrow convert IN… --to KIND`: everything in IN, files and folders, into files of their own (`convert-many.ts`).
 */
import { basename, resolve } from 'node:path';
import { withEditedTakes } from '../../dataset/edited-take.ts';
import { CommandError } from '../../edit/store.ts';
import { fitOneBvh } from '../../formats/bvh/write.ts';
import { axisAngleObstacle, inAxisAngleForm, inHierarchyForm } from '../../model/axis-angle.ts';
import { type Diagnostic, hasErrors, withoutPlace } from '../../model/diagnostic.ts';
import { type Character, EMPTY_DOCUMENT } from '../../model/document.ts';
import { type FileContent, type FileKind, type ParsedFile, stemOf } from '../../model/files.ts';
import type { Skeleton } from '../../model/skeleton.ts';
import { textureNames } from '../../model/skin.ts';
import { formatKindOf, isSaved, KINDS, WRITABLE_EXTENSIONS } from '../../project/kinds.ts';
import { openFiles } from '../../project/open/open-files.ts';
import { type Format, formatOf } from '../../project/readers.ts';
import { bvhOf, type NamedFigure, skelOf } from '../../project/save/character-files.ts';
import { outputsOf, refusal, TARGETS, type Target } from '../../project/save/conversion.ts';
import { bvhCopy, type ConversionOptions } from '../../project/save/copies.ts';
import { type Output, outputOf } from '../../project/save/output.ts';
import { copiesOf, isCopy } from '../../project/save/saving.ts';
import { type Arguments, numberOf, parseArguments, UsageError } from '../arguments.ts';
import { convertToGlb, GLB_OPTIONS, isGlb, refuseGlbOptions } from '../convert-glb.ts';
import { convertMany, type WrittenFile } from '../convert-many.ts';
import { exportGiven } from '../export/export-given.ts';
import { EDITING, editingOf, firstGiven, SHARING } from '../export/switches.ts';
import { inSpaceOf, loadTarget } from '../export/target.ts';
import type { CliCommand, CommandIo, ExitCode } from '../io.ts';
import { loadAny } from '../load.ts';
import { printJson, report } from '../report.ts';
import { writeOutput } from '../write-output.ts';

export const convert: CliCommand = {
  name: 'convert',
  usage:
    'IN… OUT [--fps N] [--tolerance T] [--json]  |  IN… OUT.glb [--keys linear|cubic] [--influences N] [--take NAME] [--no-body] …  |  IN… --to skel|anim|bvh|rig [--out FOLDER] [--force] …',
  summary:
    'writes OUT in the format of its extension, or all of IN as files of one kind (skel: with its animations; rig: with all parts)',
  details: `what is done to takes before they are written
  --retarget FILE        onto the skeleton in FILE
  --map FILE             joint pairs for it, lines "target,source"; default: matched by name and shape
  --space FILE           takes of the skeleton in FILE have its unit, up axis and ground; default: each its own guess
  --mirror               left and right exchanged, before --retarget
  --crop FROM,TO         seconds of the take; either may be left out
  --fps N                frames per second of .bvh; default: the take's own, or 30 for keys at uneven times
  --tolerance T          of keys made of samples

which takes, with --to and --out, as for export: these write each take by itself, with DIR/manifest.ndjson
  --only LIST            takes of a list, but for those with the verdict bad
  --files-from FILE      paths from the lines of FILE, or of the standard input for -
  --shard I/N, --jobs N  part I of N; threads, default: as many as cores
  --resume               skips takes whose input, options and version are those of an earlier run
  --no-times             leaves milliseconds out of the manifest
  The switches of the first list do the same with --to.
`,
  exits: {
    0: 'all was written',
    1: 'a file has errors, is missing or cannot be converted',
    2: 'wrong usage',
    3: 'all was read, but a file could not be written',
  },
  async run(args, io) {
    const given = parseArguments(args, {
      json: 'flag',
      fps: 'value',
      tolerance: 'value',
      to: 'value',
      out: 'value',
      force: 'flag',
      ...GLB_OPTIONS,
      ...EDITING,
      ...SHARING,
    });
    const to = given.value('to');
    if (to !== undefined || !isGlb(given.files.at(-1) ?? '')) refuseGlbOptions(given);
    if (to !== undefined) return toKind(given, to, io);
    if (given.value('out') !== undefined || given.flag('force')) {
      throw new UsageError('--out and --force need --to; without it, the last name is the output.');
    }
    const sharing = firstGiven(given, SHARING);
    if (sharing !== undefined)
      throw new UsageError(`--${sharing} needs --to; without it, the last name is the output.`);
    return toFile(given, io);
  },
};

function readOptions(given: Arguments): ConversionOptions {
  const positive = (name: string) => {
    const text = given.value(name);
    const value = text === undefined ? undefined : numberOf(name, text);
    if (value !== undefined && !(value > 0)) throw new UsageError(`--${name} must be greater than 0, found ${value}.`);
    return value;
  };
  const framesPerSecond = positive('fps');
  const tolerance = positive('tolerance');
  return { ...(framesPerSecond && { framesPerSecond }), ...(tolerance && { tolerance }) };
}

async function toKind(given: Arguments, to: string, io: CommandIo): Promise<ExitCode> {
  const target = TARGETS.find((t) => t === to.replace(/^\./, '').toLowerCase());
  if (!target) throw new UsageError(`--to takes one of ${TARGETS.join(', ')}, found "${to}".`);
  const out = given.value('out');
  if (firstGiven(given, { ...EDITING, ...SHARING }) !== undefined) {
    const { tolerance } = readOptions(given);
    const own = {
      to: target,
      precision: 'float64',
      isChecked: false,
      ...(tolerance !== undefined && { tolerance }),
    } as const;
    return exportGiven(given, io, own);
  }
  if (given.files.length === 0) throw new UsageError('convert needs an input file.');
  const written: WrittenFile[] = [];
  const diagnostics: Diagnostic[] = [];
  const isJson = given.flag('json');
  const options = { ...readOptions(given), target, replaces: given.flag('force'), ...(out !== undefined && { out }) };
  const isWhole = await convertMany(given.files, io.folder, options, {
    async written(file) {
      written.push(file);
      if (!isJson) await io.out(`${file.path}: ${labelOf(file.path)}, ${file.bytes} bytes\n`);
    },
    told(found) {
      diagnostics.push(...found);
      report(found, io);
    },
  });
  if (isJson) await printJson({ written, diagnostics }, io);
  return isWhole ? 0 : failureOf(diagnostics);
}

function labelOf(path: string): string {
  return formatOf(path)?.label ?? 'file';
}

async function toFile(given: Arguments, io: CommandIo): Promise<ExitCode> {
  const [ins, out] = [given.files.slice(0, -1), given.files.at(-1)];
  if (out === undefined || ins.length === 0) throw new UsageError('convert needs an input file and an output file.');
  const editing = firstGiven(given, EDITING);
  if (isGlb(out) && editing !== undefined)
    throw new UsageError(`--${editing} is not for .glb files; convert to .bvh first.`);
  if (isGlb(out)) return toGlb(given, ins, out, io);
  const format = formatOf(out);
  if (!format || !isSaved(format.format)) {
    const known = [...WRITABLE_EXTENSIONS, 'glb'].map((extension) => `.${extension}`).join(' ');
    throw new UsageError(`The format of "${out}" is not known; its name must end in one of ${known}.`);
  }
  const options = { ...readOptions(given), edit: await editOf(given, io) };
  const name = basename(out);
  const { files, diagnostics: read } = await loadAny(ins, io.folder);
  const diagnostics = [...read];
  let bytes = 0;
  if (!hasErrors(diagnostics)) {
    const picked = pickOrRefuse(files, format, name, options);
    if ('output' in picked) {
      const written = writeOutput(resolve(io.folder, out), picked.output.pieces());
      diagnostics.push(...picked.output.diagnostics());
      if ('bytes' in written) bytes = written.bytes;
      else {
        const message = `The file could not be written: ${written.failure}.`;
        diagnostics.push(refusal('file-not-written', message, name));
      }
    } else diagnostics.push(picked.refusal);
  }
  report(diagnostics, io);
  const failed = hasErrors(diagnostics);
  if (given.flag('json'))
    await printJson({ written: failed ? null : { name, kind: format.kind, bytes }, diagnostics }, io);
  else if (!failed) await io.out(`${out}: ${format.label}, ${bytes} bytes\n`);
  return failed ? failureOf(diagnostics) : 0;
}

async function toGlb(given: Arguments, ins: readonly string[], out: string, io: CommandIo): Promise<ExitCode> {
  const { files, diagnostics: read } = await loadAny(ins, io.folder);
  const diagnostics = [...read];
  let bytes = 0;
  if (!hasErrors(diagnostics)) {
    const written = await convertToGlb(given, files, out, io.folder, readOptions(given));
    diagnostics.push(...written.diagnostics);
    bytes = written.bytes;
  }
  report(diagnostics, io);
  const failed = hasErrors(diagnostics);
  if (given.flag('json')) {
    await printJson({ written: failed ? null : { name: basename(out), kind: 'character', bytes }, diagnostics }, io);
  } else if (!failed) await io.out(`${out}: glTF, ${bytes} bytes\n`);
  return failed ? failureOf(diagnostics) : 0;
}

/** What `--crop` and its like do to a character; undefined if none is given. @throws UsageError */
async function editOf(given: Arguments, io: CommandIo): Promise<Edit | undefined> {
  if (firstGiven(given, EDITING) === undefined) return undefined;
  const editing = editingOf(given);
  const { retargetOf, spaces } = await loadTarget(editing, io.folder);
  const { crop, isMirrored } = editing;
  const options = { ...(crop && { crop }), ...(isMirrored && { isMirrored }) };
  return (character) =>
    withEditedTakes(inSpaceOf(character, spaces), {
      ...options,
      ...(retargetOf && { target: retargetOf(character) }),
    });
}

type Edit = (character: Character) => Character;
type PickOptions = ConversionOptions & { readonly edit: Edit | undefined };

/** The characters of these files, edited. @throws CommandError */
function charactersOf(files: readonly ParsedFile[], { edit }: PickOptions): readonly Character[] {
  const { characters } = openFiles(EMPTY_DOCUMENT, files).document;
  return edit ? characters.map(edit) : characters;
}

/** What was read wrong is mended in the files; what could not be written, elsewhere. */
function failureOf(diagnostics: readonly Diagnostic[]): ExitCode {
  const errors = diagnostics.filter(({ severity }) => severity === 'error');
  return errors.length > 0 && errors.every(({ code }) => code === 'file-not-written') ? 3 : 1;
}

type Picked = { readonly output: Output } | { readonly refusal: Diagnostic };

/** What edits refuse, for which nothing may be left, is told as everything else. */
function pickOrRefuse(files: readonly ParsedFile[], format: Format, out: string, options: PickOptions): Picked {
  try {
    return pick(files, format, out, options);
  } catch (error) {
    if (!(error instanceof CommandError)) throw error;
    return { refusal: refusal('conversion-refused', error.message, out) };
  }
}

function pick(files: readonly ParsedFile[], format: Format, out: string, options: PickOptions): Picked {
  const { kind } = format;
  const fitting = files.filter((file) => file.kind === kind);
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
    if (only.kind === 'skel') return skelInForm(only.skeletons, only.source.name, out);
    return { output: outputOf({ name: out, content: () => only }) };
  }
  if (kind === 'rig') return rigOf(files, out);
  const target = TARGETS.find((t) => t === kind);
  const converted = target
    ? convertedTo(target, files, format, out, options)
    : (partOf(files, format, out, options) ?? copiedTo(files, format, out, options));
  if (converted) return converted;
  const held = files.map((file) => file.source.path).join(', ') || 'nothing';
  const message = `Expected ${format.label} input for ${out}, found ${held}.`;
  return { refusal: refusal('part-missing', message, out) };
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
  const message = `It names ${textures.join(', ')}, which this doesn't write. ${ALL_OF_THEM}`;
  const told = withoutPlace('info', 'texture-not-written', message, out);
  return { output: { ...output, diagnostics: () => [...output.diagnostics(), told] } };
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
    skeletons.length === 1 ? axisAngleObstacle(skeletons[0]) : `it holds one tree, and there are ${skeletons.length}.`;
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
    let figures: readonly NamedFigure[];
    try {
      figures = characters.flatMap((character) => bvhOf(character, options.framesPerSecond));
    } catch (error) {
      if (!(error instanceof CommandError)) throw error;
      return { refusal: refusal('conversion-refused', error.message, out) };
    }
    if (figures.length === 0) return undefined;
    if (characters.length > 1 || figures.length > 1) {
      const isOne = figures.length === characters.length && files.length === 1;
      if (!isOne || !fitOneBvh(figures.map(({ figure }) => figure))) {
        return {
          refusal: tooMany(
            format,
            figures.map(({ name }) => name),
            out,
          ),
        };
      }
    }
    return { output: outputOf(bvhCopy(`${stem(out)}.bvh`, figures)) };
  }
  // One kind only: `--to skel` writes skeletons with their clips. A `.skel` may have several roots.
  const skeletons = characters.flatMap((character) => skelOf(character) ?? []);
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
