/**
 * `marrow convert IN… OUT`: writes OUT in the format of its name, from whatever IN holds of that kind. A `.rig` is
 * made, where none is given, of the names of the files that are.
 *
 * OUT is written beside its place and moved there whole, so that it may be one of IN, and never half a file.
 */
import { renameSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { basename, resolve } from 'node:path';
import { type Format, formatOf, READABLE_EXTENSIONS } from '../../formats/registry.ts';
import { writeFile } from '../../formats/write.ts';
import { type Diagnostic, hasErrors } from '../../model/diagnostic.ts';
import { type FileContent, type FileKind, type ParsedFile, stemOf } from '../../model/files.ts';
import { parseArguments, UsageError } from '../arguments.ts';
import type { Command } from '../io.ts';
import { loadFiles } from '../load.ts';
import { printJson, report } from '../report.ts';

export const convert: Command = {
  name: 'convert',
  usage: 'IN… OUT [--json]',
  summary: 'writes OUT in the format of its name, from what IN holds',
  async run(args, io) {
    const given = parseArguments(args, { json: 'flag' });
    const [ins, out] = [given.files.slice(0, -1), given.files.at(-1)];
    if (out === undefined || ins.length === 0) throw new UsageError('convert takes what to read and what to write.');
    const format = formatOf(out);
    if (!format) {
      const known = READABLE_EXTENSIONS.map((extension) => `.${extension}`).join(' ');
      throw new UsageError(`The format of "${out}" is not known; its name has to end in one of ${known}.`);
    }

    const name = basename(out);
    const { files, diagnostics: read } = loadFiles(ins, io.folder);
    const diagnostics = [...read];
    let bytes = 0;
    if (!hasErrors(diagnostics)) {
      const picked = pick(files, format, name);
      if ('content' in picked) {
        const written = writeFile(picked.content, name);
        diagnostics.push(...(written?.diagnostics ?? []));
        const failure = written ? replaceFile(resolve(io.folder, out), written.text) : 'there is no writer for it';
        if (failure === undefined) bytes = Buffer.byteLength(written?.text ?? '');
        else diagnostics.push(refusal('file-not-written', `The file could not be written: ${failure}.`, name));
      } else diagnostics.push(picked.refusal);
    }
    report(diagnostics, io);
    const failed = hasErrors(diagnostics);
    if (given.flag('json'))
      await printJson({ written: failed ? null : { name, kind: format.kind, bytes }, diagnostics }, io);
    else if (!failed) await io.out(`${out}: ${format.label}, ${bytes} bytes\n`);
    return failed ? 1 : 0;
  },
};

function pick(
  files: readonly ParsedFile[],
  format: Format,
  out: string,
): { readonly content: FileContent } | { readonly refusal: Diagnostic } {
  const fitting = files.filter((file) => file.kind === format.kind);
  if (fitting.length === 1) return { content: fitting[0] };
  const names = fitting.map((file) => file.source.name).join(', ');
  if (fitting.length > 1) {
    const message = `More than one ${format.label} was given (${names}), and ${out} holds one: name only that one.`;
    return { refusal: refusal('part-ambiguous', message, out) };
  }
  if (format.kind === 'rig') return rigOf(files, out);
  const held = files.map((file) => file.source.name).join(', ') || 'nothing that was read';
  const message = `No ${format.label} was given to write ${out} from: there is ${held}.`;
  return { refusal: refusal('part-missing', message, out) };
}

/** A rig that names the files given. */
function rigOf(files: readonly ParsedFile[], out: string) {
  const named = (kind: FileKind) => files.filter((file) => file.kind === kind).map((file) => file.source.name);
  const [skeletons, skins, morphs, animations] = (['skel', 'skin', 'morph', 'anim'] as const).map(named);
  const twice = [skeletons, skins, animations].find((names) => names.length > 1);
  if (twice) {
    const message = `A rig names one file of each kind, and there are ${twice.join(', ')}.`;
    return { refusal: refusal('part-ambiguous', message, out) };
  }
  if (skeletons.length + skins.length + morphs.length + animations.length === 0) {
    return { refusal: refusal('part-missing', 'No file was given that a rig could name.', out) };
  }
  const content: FileContent = {
    kind: 'rig',
    rig: {
      name: stemOf({ name: out, path: out, bytes: 0 }),
      ...(skeletons.length && { skeleton: skeletons[0] }),
      ...(skins.length && { skin: skins[0] }),
      morphs,
      ...(animations.length && { animation: animations[0] }),
    },
  };
  return { content };
}

/** Undefined when done, else why not; then what was there is as it was. */
function replaceFile(path: string, text: string): string | undefined {
  const scratch = `${path}.${process.pid}.tmp`;
  try {
    const there = statSync(path, { throwIfNoEntry: false });
    if (there && !there.isFile()) return 'something that is not a file has this name';
    writeFileSync(scratch, text, { flag: 'wx', ...(there && { mode: there.mode }) });
    renameSync(scratch, path);
    return undefined;
  } catch (error) {
    rmSync(scratch, { force: true });
    return error instanceof Error ? error.message : String(error);
  }
}

function refusal(code: string, message: string, file: string): Diagnostic {
  return { severity: 'error', code, message, file, line: 0, column: 0 };
}
