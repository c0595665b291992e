/**
 * `marrow convert IN… OUT`: writes OUT in the format of its extension, from content of that kind in IN, or from what
 * can be converted to it: `.skel` and `.anim` from motion capture, `.bvh` from any skeleton and its take. Without a
 * `.rig` in IN, one is written that names the given files.
 *
 * `marrow convert IN… OUT.glb` or `OUT.fbx`: a character with its takes (`convert-exchange.ts`).
 *
 * `marrow convert IN… --to KIND`: everything in IN, files and folders, into files of their own (`convert-many.ts`);
 * takes that are edited, and files of other programs, one by one (`export/`).
 */
import { basename, dirname, join, resolve } from 'node:path';
import { withEditedTakes } from '../../dataset/edited-take.ts';
import { withAllTangents } from '../../edit/keys/tangents.ts';
import { EXCHANGE_FORMATS, type ExchangeFormat, exchangeOf, isExchange } from '../../export/formats.ts';
import { isSaved, WRITABLE_EXTENSIONS } from '../../files/kinds.ts';
import { formatOf } from '../../files/readers.ts';
import { refusal } from '../../files/save/conversion.ts';
import type { ConversionOptions } from '../../files/save/copies.ts';
import { type Diagnostic, hasErrors } from '../../model/diagnostic.ts';
import type { ParsedFile } from '../../model/files.ts';
import type { Take } from '../../model/takes/take.ts';
import { NEW_KEY_TANGENTS, type NewKeyTangents, TANGENT_KINDS } from '../../model/takes/tangent-kinds.ts';
import { convertToExchange, EXCHANGE_OPTIONS, refuseOptions } from '../convert-exchange.ts';
import { convertMany, type WrittenFile } from '../convert-many.ts';
import { type Edit, pickOrRefuse } from '../convert-one.ts';
import { exportGiven } from '../export/export-given.ts';
import { FORMAT_NAMES } from '../export/formats.ts';
import { MOTION_KINDS, type MotionKind } from '../export/motion-files.ts';
import { EDITING, editingOf, firstGiven, SHARING } from '../export/switches.ts';
import { inSpaceOf, loadTarget } from '../export/target.ts';
import type { CommandIo, ExitCode } from '../io.ts';
import { atKnownRate } from '../known-rate.ts';
import { type Loaded, loadAny } from '../load.ts';
import { anyInputs } from '../options/inputs.ts';
import { KEEP_OPTION } from '../options/keep.ts';
import { ending, oneOf, positive, text } from '../options/kinds.ts';
import { flag, type OptionValues, option } from '../options/option.ts';
import { shellCommand } from '../options/shell-command.ts';
import { printJson, report } from '../report.ts';
import { UsageError } from '../usage-error.ts';
import { writeOutput } from '../write-output.ts';

const OPTIONS = {
  to: option(
    ending(MOTION_KINDS),
    'Writes everything in IN as files of this kind: skel with animations, asf with its motions, rig with all parts, trc with points alone, glb, fbx and vrma with one character per take.',
  ),
  out: option(text('DIR', 'a folder'), 'Writes into this folder instead of next to each file.', { needs: 'to' }),
  force: flag('Overwrites existing files.', { needs: 'to' }),
  fps: option(
    positive('N'),
    "Writes `.bvh` at this many frames per second instead of the take's own, or 30 for keys at uneven times, and `.glb`, `.fbx` and `.vrma` with a key per frame at this rate.",
  ),
  tolerance: option(positive('X'), 'Lets keys deviate this much from the samples they replace.'),
  tangents: option(
    oneOf(NEW_KEY_TANGENTS),
    'Sets both sides of every key to this kind of tangent; a `.anim` has `auto` as numbers.',
  ),
  ...KEEP_OPTION,
  json: flag('Prints the names and sizes of the written files as JSON, with all problems.'),
  ...EXCHANGE_OPTIONS,
  ...EDITING,
  ...SHARING,
};
type ConvertOptions = OptionValues<typeof OPTIONS>;

export const convert = shellCommand({
  name: 'convert',
  summary: 'Writes OUT in the format its extension names, or everything in IN as files of one kind.',
  inputs: anyInputs(['IN… OUT', `IN… --to ${MOTION_KINDS.join('|')}`], {
    IN: 'Files, folders and zips.',
    OUT: `The file to write, which ends in ${[...WRITABLE_EXTENSIONS, ...EXCHANGE_FORMATS].map((each) => `.${each}`).join(', ')}.`,
  }),
  options: OPTIONS,
  about: [
    'With `--to` and `--out`, options that edit or choose takes write each take separately, as `marrow export` does, with `DIR/manifest.ndjson`.',
  ],
  examples: [
    'marrow convert wasp.skel wasp.skin wasp_walk.anim wasp.glb',
    'marrow convert take.bvh --retarget other.bvh --crop 2,10 out.bvh',
  ],
  exits: {
    0: 'everything was written',
    1: 'a file has errors, is missing or cannot be converted',
    2: 'wrong usage',
    3: 'everything was read, but a file could not be written',
  },
  async run({ inputs, options }, io) {
    const { to } = options;
    refuseOptions(to === undefined ? exchangeOf(inputs.at(-1) ?? '') : undefined, options);
    return to === undefined ? toFile(inputs, options, io) : toKind(inputs, options, to, io);
  },
});

function conversionOf({ fps: framesPerSecond, tolerance }: ConvertOptions): ConversionOptions {
  return { ...(framesPerSecond !== undefined && { framesPerSecond }), ...(tolerance !== undefined && { tolerance }) };
}

async function toKind(
  inputs: readonly string[],
  options: ConvertOptions,
  target: MotionKind,
  io: CommandIo,
): Promise<ExitCode> {
  const { out, tolerance, force: replaces, json: isJson } = options;
  if (isExchange(target) || firstGiven(options, { ...EDITING, ...SHARING }) !== undefined) {
    if (out === undefined) throw new UsageError('--out is missing: the folder for the converted files.');
    return exportGiven(inputs, { ...options, out }, io, {
      to: target,
      precision: 'float64',
      isChecked: false,
      ...(tolerance !== undefined && { tolerance }),
    });
  }
  if (options.tangents !== undefined) throw new UsageError('--tangents is for one output file, not for --to.');
  if (inputs.length === 0) throw new UsageError('convert needs an input file.');
  const written: WrittenFile[] = [];
  const diagnostics: Diagnostic[] = [];
  const many = { ...conversionOf(options), target, replaces, ...(out !== undefined && { out }) };
  const isWhole = await convertMany(inputs, io.folder, many, {
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

async function toFile(inputs: readonly string[], given: ConvertOptions, io: CommandIo): Promise<ExitCode> {
  const [ins, out] = [inputs.slice(0, -1), inputs.at(-1)];
  if (out === undefined || ins.length === 0) throw new UsageError('convert needs an input file and an output file.');
  const exchange = exchangeOf(out);
  if (exchange) return toExchange(exchange, [ins, out], given, io);
  const format = formatOf(out);
  if (!format || !isSaved(format.format)) {
    const arrays = FORMAT_NAMES.find((name) => out.toLowerCase().endsWith(`.${name}`));
    if (arrays)
      throw new UsageError(`Arrays are written by "marrow export --to ${arrays}", for ${out} and many takes alike.`);
    const known = [...WRITABLE_EXTENSIONS, ...EXCHANGE_FORMATS].map((extension) => `.${extension}`).join(' ');
    throw new UsageError(`The format of "${out}" is unknown; its name must end in one of ${known}.`);
  }
  const options = { ...conversionOf(given), edit: await editOf(given, io) };
  const name = basename(out);
  const { files, diagnostics: read } = await loadKnown(ins, given, io);
  const diagnostics = [...read];
  const sizes: { readonly path: string; readonly bytes: number }[] = [];
  if (!hasErrors(diagnostics)) {
    const picked = pickOrRefuse(withTangents(files, given.tangents), format, name, options);
    if ('output' in picked) {
      for (const output of [picked.output, ...(picked.beside ?? [])]) {
        const path = picked.beside ? join(dirname(out), output.name) : out;
        const written = writeOutput(resolve(io.folder, path), output.pieces());
        diagnostics.push(...output.diagnostics());
        if ('bytes' in written) sizes.push({ path, bytes: written.bytes });
        else {
          const message = `The file could not be written: ${written.failure}.`;
          diagnostics.push(refusal('file-not-written', message, output.name));
        }
      }
    } else diagnostics.push(picked.refusal);
  }
  report(diagnostics, io);
  const failed = hasErrors(diagnostics);
  const [first] = sizes;
  const result = first && { name, kind: format.kind, bytes: first.bytes };
  if (given.json) await printJson({ written: failed || !result ? null : result, diagnostics }, io);
  else if (!failed) for (const { path, bytes } of sizes) await io.out(`${path}: ${labelOf(path)}, ${bytes} bytes\n`);
  return failed ? failureOf(diagnostics) : 0;
}

async function toExchange(
  format: ExchangeFormat,
  [ins, out]: readonly [ins: readonly string[], out: string],
  given: ConvertOptions,
  io: CommandIo,
): Promise<ExitCode> {
  const options = { ...conversionOf(given), edit: await editOf(given, io) };
  const { files, diagnostics: read } = await loadKnown(ins, given, io);
  const diagnostics = [...read];
  let bytes = 0;
  if (!hasErrors(diagnostics)) {
    const taken = withTangents(files, given.tangents);
    const written = await convertToExchange({ format, given }, taken, out, io.folder, options);
    diagnostics.push(...written.diagnostics);
    bytes = written.bytes;
  }
  report(diagnostics, io);
  const failed = hasErrors(diagnostics);
  if (given.json) {
    await printJson({ written: failed ? null : { name: basename(out), kind: 'character', bytes }, diagnostics }, io);
  } else if (!failed) await io.out(`${out}: ${labelOf(out)}, ${bytes} bytes\n`);
  return failed ? failureOf(diagnostics) : 0;
}

/** What the arguments name, with the rate that is given for files without one. */
async function loadKnown(ins: readonly string[], { keep, rate }: ConvertOptions, io: CommandIo): Promise<Loaded> {
  return atKnownRate(await loadAny(ins, io.folder, { keep }), rate);
}

/** The files with one kind of tangent on both sides of all keys. */
function withTangents(files: readonly ParsedFile[], kind: NewKeyTangents | undefined): readonly ParsedFile[] {
  if (kind === undefined) return files;
  const set = (take: Take) => withAllTangents(take, TANGENT_KINDS.indexOf(kind));
  return files.map((file) => {
    if (file.kind === 'anim') return { ...file, take: set(file.take) };
    if (file.kind !== 'character') return file;
    return { ...file, characters: file.characters.map((each) => ({ ...each, takes: each.takes.map(set) })) };
  });
}

/** What `--crop` and its like do to a character; undefined if none is given. @throws UsageError */
async function editOf(given: ConvertOptions, io: CommandIo): Promise<Edit | undefined> {
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

/** What was read wrong is fixed in the files; what could not be written, elsewhere. */
function failureOf(diagnostics: readonly Diagnostic[]): ExitCode {
  const errors = diagnostics.filter(({ severity }) => severity === 'error');
  return errors.length > 0 && errors.every(({ code }) => code === 'file-not-written') ? 3 : 1;
}
