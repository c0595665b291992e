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
import { importedFrom, isBuffer, waitingBuffer } from './parse-imports.ts';
import { sourceOf, tooLargeToPost, unreadable } from './parsed-blob.ts';
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

  const before = (input.before ?? []).filter((file) => !given.some(({ path }) => path === file.path));
  const { imported, keeps } = await importedFrom(given, before, diagnostics, count);
  for (const { path } of before) files.push(...(imported.get(path)?.files ?? []));

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
    } else if (isBuffer(source.name)) diagnostics.push(waitingBuffer(source));
    else passedOver.push(source);
  }
  // A readme beside a character is only worth an info.
  const severity = files.length || broken.length ? 'info' : 'warning';
  for (const source of passedOver) diagnostics.push(skipped(source, unknownFormatMessage(), severity));
  for (const source of withoutNumbers) diagnostics.push(skipped(source, emptyDumpMessage(source.bytes), severity));

  return { files, broken, diagnostics, facts: factsOf(files), keeps };
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

function isReadable(name: string): boolean {
  return formatOf(name) !== undefined || isBuffer(name);
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

function skipped({ name }: SourceFile, message: string, severity: 'info' | 'warning'): Diagnostic {
  return withoutPlace(severity, 'format-unknown', message, name, 'skipped');
}

function unknownFormatMessage(): string {
  const known = [...READABLE_EXTENSIONS, 'zip'].map((e) => `.${e}`).join(' ');
  return `Marrow does not read this kind of file; it reads ${known}.`;
}
