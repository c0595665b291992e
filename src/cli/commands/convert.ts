/**
 * `marrow convert IN… OUT`: writes OUT in the format of its extension, from content of that kind in IN, or from what
 * can be converted to it: `.skel` and `.anim` from motion capture, `.bvh` from any skeleton and its clip. Without a
 * `.rig` in IN, one is written that names the given files.
 *
 * `marrow convert IN… OUT.glb`: a character with its takes (`convert-glb.ts`).
 *
 * `marrow convert IN… --to KIND`: everything in IN, files and folders, into files of their own (`convert-many.ts`); takes
 * that are edited, and GLB, one by one (`export/`).
 */
import { basename, resolve } from 'node:path';
import { withEditedTakes } from '../../dataset/edited-take.ts';
import { type Diagnostic, hasErrors } from '../../model/diagnostic.ts';
import { isSaved, WRITABLE_EXTENSIONS } from '../../project/kinds.ts';
import { formatOf } from '../../project/readers.ts';
import { refusal } from '../../project/save/conversion.ts';
import type { ConversionOptions } from '../../project/save/copies.ts';
import { type Arguments, numberOf, parseArguments, UsageError } from '../arguments.ts';
import { convertToGlb, GLB_OPTIONS, isGlb, refuseGlbOptions } from '../convert-glb.ts';
import { convertMany, type WrittenFile } from '../convert-many.ts';
import { type Edit, pickOrRefuse } from '../convert-one.ts';
import { exportGiven } from '../export/export-given.ts';
import { MOTION_KINDS } from '../export/motion-files.ts';
import { EDITING, editingOf, firstGiven, SHARING } from '../export/switches.ts';
import { inSpaceOf, loadTarget } from '../export/target.ts';
import type { CliCommand, CommandIo, ExitCode } from '../io.ts';
import { loadAny } from '../load.ts';
import { printJson, report } from '../report.ts';
import { writeOutput } from '../write-output.ts';

export const convert: CliCommand = {
  name: 'convert',
  usage:
    'IN… OUT [--fps N] [--tolerance T] [--json]  |  IN… OUT.glb [--keys linear|cubic] [--influences N] [--take NAME] [--no-body] [--raw] …  |  IN… --to skel|anim|bvh|rig|glb [--out FOLDER] [--force] …',
  summary:
    'writes OUT in the format of its extension, or all of IN as files of one kind (skel: with its animations; rig: with all parts; glb: a character for each take)',
  details: `what is done to takes before they are written
  --retarget FILE        onto the character in FILE, a folder or zip too; given again, onto that in several files
  --map FILE             joint pairs for it, lines "target,source"; default: matched by name and shape
  --space FILE           takes of the skeleton in FILE have its unit, up axis and ground; default: each its own
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
  const target = MOTION_KINDS.find((kind) => kind === to.replace(/^\./, '').toLowerCase());
  if (!target) throw new UsageError(`--to takes one of ${MOTION_KINDS.join(', ')}, found "${to}".`);
  const out = given.value('out');
  if (target === 'glb' || firstGiven(given, { ...EDITING, ...SHARING }) !== undefined) {
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
  const options = { ...readOptions(given), edit: await editOf(given, io) };
  const { files, diagnostics: read } = await loadAny(ins, io.folder);
  const diagnostics = [...read];
  let bytes = 0;
  if (!hasErrors(diagnostics)) {
    const written = await convertToGlb(given, files, out, io.folder, options);
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

/** What was read wrong is mended in the files; what could not be written, elsewhere. */
function failureOf(diagnostics: readonly Diagnostic[]): ExitCode {
  const errors = diagnostics.filter(({ severity }) => severity === 'error');
  return errors.length > 0 && errors.every(({ code }) => code === 'file-not-written') ? 3 : 1;
}
