/**
 * The `parse` job: files in, models and diagnostics out. Bytes are fed to the format's reader as they arrive; zips are
 * unpacked here, and formats are recognised by file name only.
 */

import { checkMorph } from '../evaluate/binding.ts';
import { skinFacts } from '../evaluate/bounds.ts';
import { isWorthDiagnosing } from '../formats/diagnose/diagnose.ts';
import { foldUnreadable } from '../formats/diagnose/fold.ts';
import { unzip } from '../formats/unzip.ts';
import { type Diagnostic, withoutPlace } from '../model/diagnostic.ts';
import { emptyDumpMessage, isEmptyDump } from '../model/dump.ts';
import { type BrokenFile, folderOf, type ParsedFile, type SourceFile } from '../model/files.ts';
import type { Morph } from '../model/morph.ts';
import type { Skin } from '../model/skin.ts';
import { READABLE_EXTENSIONS } from '../project/kinds.ts';
import { type Format, formatOf } from '../project/readers.ts';
import type { GivenBlob, ParseInput, ParseOutput, Progress } from './protocol.ts';
import { transferables } from './transferables.ts';

/** Interval of progress messages: enough for a smooth bar, at negligible cost. */
const PROGRESS_STEP_BYTES = 1 << 20;

export async function parse(input: ParseInput, onProgress: (progress: Progress) => void): Promise<ParseOutput> {
  const diagnostics: Diagnostic[] = [];
  const files: ParsedFile[] = [];
  const broken: BrokenFile[] = [];
  const { given, passedOver } = await unpacked(input.files, diagnostics);
  const withoutNumbers: SourceFile[] = [];
  const bytesTotal = given.reduce((sum, { blob }) => sum + blob.size, 0);
  let bytesDone = 0;
  let told = 0;

  const count = (name: string, bytes: number) => {
    bytesDone += bytes;
    if (bytes > 0 && bytesDone - told < PROGRESS_STEP_BYTES && told > 0) return;
    told = bytesDone;
    onProgress({ label: name, done: bytesDone, of: bytesTotal });
  };

  const imported = await importedFrom(given, diagnostics, count);

  for (const { path, blob } of given) {
    const source = sourceOf(path, blob.size);
    const whole = imported.get(path);
    if (whole) {
      files.push(...whole.files);
      broken.push(...whole.broken);
      continue;
    }
    const format = formatOf(source.name);
    if (format) {
      const reader = format.reader(source.name, source.bytes);
      try {
        await feed(blob, (chunk) => {
          reader.feed(chunk);
          count(source.name, chunk.byteLength);
        });
      } catch (error) {
        diagnostics.push(unreadable(source, error));
        broken.push({ kind: format.kind, source });
        continue;
      }
      const result = reader.end();
      diagnostics.push(...(await located(format, source.name, blob, result.diagnostics)));
      const tooLarge = result.value && tooLargeToPost(source, transferables(result.value));
      if (tooLarge) {
        diagnostics.push(tooLarge);
        broken.push({ kind: format.kind, source });
      } else if (result.value && isEmptyDump(result.value)) withoutNumbers.push(source);
      else if (result.value) files.push({ ...result.value, source });
      else broken.push({ kind: format.kind, source });
    } else passedOver.push(source);
  }
  // A readme beside a character is only worth an info.
  const severity = files.length || broken.length ? 'info' : 'warning';
  for (const source of passedOver) diagnostics.push(skipped(source, unknownFormatMessage(), severity));
  for (const source of withoutNumbers) diagnostics.push(skipped(source, emptyDumpMessage(source.bytes), severity));

  return { files, broken, diagnostics, facts: factsOf(files) };
}

interface ImportedBlob {
  readonly files: readonly ParsedFile[];
  readonly broken: readonly BrokenFile[];
}

/** What becomes of the files of other programs, and of those that are parts of them, by their paths. */
async function importedFrom(
  given: readonly GivenBlob[],
  diagnostics: Diagnostic[],
  count: (name: string, bytes: number) => void,
): Promise<ReadonlyMap<string, ImportedBlob>> {
  const out = new Map<string, ImportedBlob>();
  for (const { path, blob } of given) {
    const source = sourceOf(path, blob.size);
    const format = formatOf(source.name);
    if (!format?.imports) continue;
    // Its name is told before it is read: it is read as a whole, which may take long.
    count(source.name, 0);
    const { besideIn } = await import('../project/imports.ts');
    const find = besideIn(path, given, (file) => file.path);
    let bytesRead = blob.size;
    try {
      const {
        value,
        diagnostics: told,
        beside,
      } = await format.imports({
        fileName: source.name,
        bytes: new Uint8Array(await blob.arrayBuffer()),
        beside: async (relative) => {
          const found = find(relative);
          if (!found) return undefined;
          const bytes = new Uint8Array(await found.blob.arrayBuffer());
          return { bytes, source: sourceOf(found.path, found.blob.size) };
        },
      });
      diagnostics.push(...told);
      bytesRead += beside.reduce((sum, { path: own, bytes }) => sum + (out.has(own) ? 0 : bytes), 0);
      for (const part of beside) out.set(part.path, { files: [], broken: [] });
      const tooLarge = value && tooLargeToPost(source, transferables(value));
      if (tooLarge) diagnostics.push(tooLarge);
      if (value && !tooLarge) out.set(path, { files: [{ ...value, source, beside }], broken: [] });
      else out.set(path, { files: [], broken: [{ kind: format.kind, source }] });
    } catch (error) {
      diagnostics.push(unreadable(source, error));
      out.set(path, { files: [], broken: [{ kind: format.kind, source }] });
    }
    count(source.name, bytesRead);
  }
  return out;
}

/**
 * Of each skin, with the morphs given with it: whether they belong to it is not known yet, so some may be superfluous.
 */
function factsOf(files: readonly ParsedFile[]): ParseOutput['facts'] {
  return files.flatMap((file) => {
    if (file.kind === 'character') {
      return file.characters.flatMap(({ skins, morphs }) =>
        skins.map((skin) => {
          const own = morphs.filter((morph) => fits(morph, skin));
          return { skin, morphs: own, facts: skinFacts(skin, own) };
        }),
      );
    }
    if (file.kind !== 'skin') return [];
    const { skin, source } = file;
    const beside = files.filter((f) => f.kind === 'morph' && folderOf(f.source) === folderOf(source));
    const morphs = beside.flatMap((f) => (f.kind === 'morph' && fits(f.morph, skin) ? [f.morph] : []));
    return [{ skin, morphs, facts: skinFacts(skin, morphs) }];
  });
}

function fits(morph: Morph, skin: Skin): boolean {
  return checkMorph(morph, skin, '').length === 0;
}

function sourceOf(path: string, bytes: number): SourceFile {
  return { name: path.slice(path.lastIndexOf('/') + 1), path, bytes };
}

function isReadable(name: string): boolean {
  // Buffers of glTF files.
  return formatOf(name) !== undefined || name.toLowerCase().endsWith('.bin');
}

/** The given files, with zips replaced by their content. */
async function unpacked(files: readonly GivenBlob[], diagnostics: Diagnostic[]) {
  const given: GivenBlob[] = [];
  /** Inside zips, of unknown kinds. */
  const passedOver: SourceFile[] = [];
  for (const file of files) {
    if (!file.path.toLowerCase().endsWith('.zip')) {
      given.push(file);
      continue;
    }
    const source = sourceOf(file.path, file.blob.size);
    try {
      const { entries, passedOver: other } = unzip(new Uint8Array(await file.blob.arrayBuffer()), isReadable);
      // In a folder named after the archive, since files packed together belong together.
      for (const { path, bytes } of entries) given.push({ path: `${file.path}/${path}`, blob: new Blob([bytes]) });
      for (const path of other) passedOver.push(sourceOf(`${file.path}/${path}`, 0));
    } catch (error) {
      diagnostics.push(unreadable(source, error));
    }
  }
  return { given, passedOver };
}

/** The problems at their places. The file is read again for it, so only if there are any. */
async function located(
  { diagnose }: Format,
  name: string,
  blob: Blob,
  told: readonly Diagnostic[],
): Promise<readonly Diagnostic[]> {
  if (!diagnose || !isWorthDiagnosing(told, blob.size)) return foldUnreadable(told);
  try {
    return foldUnreadable(diagnose(name, new Uint8Array(await blob.arrayBuffer()), told));
  } catch (error) {
    // The file has changed on disk since it was read.
    if (error instanceof DOMException) return foldUnreadable(told);
    throw error;
  }
}

async function feed(blob: Blob, take: (chunk: Uint8Array) => void): Promise<void> {
  const reader = blob.stream().getReader();
  for (let next = await reader.read(); !next.done; next = await reader.read()) take(next.value);
}

/** Browsers refuse to pass on larger buffers, with words about `postMessage`. */
const MOST_BYTES = 2 ** 31 - 1;

/** What is wrong if a file's numbers can't be passed from the worker to the page. */
export function tooLargeToPost(
  { name }: SourceFile,
  buffers: readonly { readonly byteLength: number }[],
): Diagnostic | undefined {
  const largest = buffers.reduce((most, { byteLength }) => Math.max(most, byteLength), 0);
  if (largest <= MOST_BYTES) return undefined;
  const found = `Its values take ${(largest / 1e9).toFixed(1)} GB; the page takes up to ${(MOST_BYTES / 1e9).toFixed(1)} GB of a file.`;
  const now = 'The command reads larger files: "marrow convert IN OUT --fps N" writes fewer frames.';
  return withoutPlace('error', 'file-too-large', `${found} ${now}`, name);
}

function unreadable(source: SourceFile, error: unknown): Diagnostic {
  const reason = error instanceof Error ? error.message : String(error);
  const message = `The file could not be read: ${reason}. It may have moved or be damaged. Try opening it again.`;
  return withoutPlace('error', 'file-unreadable', message, source.name);
}

function skipped({ name }: SourceFile, message: string, severity: 'info' | 'warning'): Diagnostic {
  return withoutPlace(severity, 'format-unknown', message, name, 'skipped');
}

function unknownFormatMessage(): string {
  const known = [...READABLE_EXTENSIONS, 'zip'].map((e) => `.${e}`).join(' ');
  return `Marrow does not read this kind of file; it reads ${known}.`;
}
