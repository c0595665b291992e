/**
 * The `parse` job: files in, models and diagnostics out. Bytes are fed to the format's reader as they arrive; zips are
 * unpacked here, and formats are recognised by file name only.
 */

import { checkMorph } from '../evaluate/skin/binding.ts';
import { skinFacts } from '../evaluate/skin/bounds.ts';
import { otherContent, readableList, unreadMessage } from '../files/foreign.ts';
import { isBuffer } from '../files/kinds.ts';
import { bodiesIn } from '../files/open/bodies.ts';
import { editedPlainFiles, joinLayers, plainFilesIn } from '../files/open/layers.ts';
import { type Format, formatOf } from '../files/readers.ts';
import { isZip, MAX_FILES, tooManyFiles, zipContent } from '../files/zip-content.ts';
import { isWorthDiagnosing } from '../formats/diagnose/diagnose.ts';
import { foldUnreadable } from '../formats/diagnose/fold.ts';
import { sha256 } from '../formats/sha256.ts';
import { ZipRefusal } from '../formats/unzip.ts';
import { type Diagnostic, withoutPlace } from '../model/diagnostic.ts';
import { emptyDumpMessage, isEmptyDump } from '../model/dump.ts';
import { type BrokenFile, baseName, byFileName, byPath, type ParsedFile, type SourceFile } from '../model/files.ts';
import { importedFrom, waitingBuffer } from './parse-imports.ts';
import { sourceOf, tooLargeToPost, unreadable } from './parsed-blob.ts';
import { passageOf } from './passage.ts';
import type { GivenBlob, ParseInput, ParseOutput, Progress } from './protocol.ts';
import { ReadAhead } from './read-ahead.ts';

/** Interval of progress messages: enough for a smooth bar, at negligible cost. */
const PROGRESS_STEP_BYTES = 1 << 20;
/** Text of fewer bytes never holds too many numbers for the page: each takes two of them at least. */
const LARGE_BYTES = 1 << 27;
/** Files of unknown kinds in a zip that are told one by one; more are counted. */
const MAX_TOLD = 100;

export async function parse(
  input: ParseInput,
  onProgress: (progress: Progress) => void,
  maxFiles = MAX_FILES,
): Promise<ParseOutput> {
  const diagnostics: Diagnostic[] = [];
  const files: ParsedFile[] = [];
  const broken: BrokenFile[] = [];
  const { given, passedOver, uncounted } = await unpacked(input.files, diagnostics, maxFiles);
  if (given.length > maxFiles) {
    const of = given.length.toLocaleString('en');
    diagnostics.push(
      withoutPlace('error', 'too-many-files', `None of the ${of} files was opened: ${tooManyFiles(maxFiles)}.`, ''),
    );
    return { files, broken, diagnostics, facts: [], keeps: [] };
  }
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

  const bytes = new ReadAhead(
    given.flatMap(({ path, blob }) => (imported.has(path) || !formatOf(baseName(path)) ? [] : [blob])),
  );
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
        await bytes.read(blob, (chunk) => {
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
      const isLarge = source.bytes > LARGE_BYTES;
      const tooLarge = isLarge && result.value && tooLargeToPost(source, passageOf(result.value).transfer);
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
  diagnostics.push(...unreadFiles({ passedOver, uncounted }, severity));
  for (const source of withoutNumbers) diagnostics.push(skipped(source, emptyDumpMessage(source.bytes), severity));

  const { joined, ...layers } = await joinedFiles(files, given, input.keep, diagnostics);
  return { files: joined, broken, diagnostics, facts: factsOf(joined, broken), keeps, ...layers };
}

/** The files with those of takes with layers as one, and what the output says about these. */
async function joinedFiles(
  files: readonly ParsedFile[],
  given: readonly GivenBlob[],
  keep: ParseInput['keep'],
  diagnostics: Diagnostic[],
): Promise<{ readonly joined: readonly ParsedFile[] } & Pick<ParseOutput, 'layers'>> {
  const hashed = await withHashes(files, given);
  const { files: joined, diagnostics: problems } = joinLayers(hashed, keep ?? 'edit', byFileName);
  diagnostics.push(...problems);
  if (joined === hashed) return { joined };
  const edited = editedPlainFiles(hashed).map(({ source }) => source);
  const hasNamesakes = new Set(edited.map(byFileName)).size < edited.length;
  return { joined, layers: { edited: edited.map(hasNamesakes ? byPath : byFileName) } };
}

/** The files with the hashes that others of them ask for. */
async function withHashes(files: readonly ParsedFile[], given: readonly GivenBlob[]): Promise<readonly ParsedFile[]> {
  const asked = new Set(plainFilesIn(files));
  return Promise.all(
    files.map(async (file) => {
      const blob = asked.has(file) ? given.find(({ path }) => path === file.source.path)?.blob : undefined;
      return blob ? { ...file, sha256: sha256(new Uint8Array(await blob.arrayBuffer())) } : file;
    }),
  );
}

function unreadFiles(
  { passedOver, uncounted }: Pick<Awaited<ReturnType<typeof unpacked>>, 'passedOver' | 'uncounted'>,
  severity: 'info' | 'warning',
): readonly Diagnostic[] {
  const counted = uncounted.map(({ source, count }) => {
    const several = `${count.toLocaleString('en')} files in it`;
    const message = `${several} are of types that Marrow does not read; it reads ${readableList()}.`;
    return skipped(source, message, severity);
  });
  return [...passedOver.map((source) => skipped(source, unreadMessage(source.name), severity)), ...counted];
}

function factsOf(files: readonly ParsedFile[], broken: readonly BrokenFile[]): ParseOutput['facts'] {
  return bodiesIn(files, broken).map(({ skin, morphs }) => {
    const fitting = morphs.filter((morph) => checkMorph(morph, skin, '').length === 0);
    return { skin, morphs: fitting, facts: skinFacts(skin, fitting) };
  });
}

function isReadable(name: string): boolean {
  return formatOf(name) !== undefined || isBuffer(name);
}

/** The given files, with zips replaced by their content. */
async function unpacked(files: readonly GivenBlob[], diagnostics: Diagnostic[], maxFiles: number) {
  const given: GivenBlob[] = [];
  /** Inside zips, of unknown kinds. */
  const passedOver: SourceFile[] = [];
  /** Zips with many of these, which aren't among them. */
  const uncounted: { readonly source: SourceFile; readonly count: number }[] = [];
  for (const file of files) {
    if (!isZip(file.path)) {
      given.push(file);
      continue;
    }
    const source = sourceOf(file.path, file.blob.size);
    try {
      const bytes = new Uint8Array(await file.blob.arrayBuffer());
      const foreign = otherContent(source.name, 'zip', bytes);
      if (foreign) {
        diagnostics.push(foreign);
        continue;
      }
      const { files: inside, passedOver: other } = zipContent(file.path, bytes, isReadable, { maxFiles });
      for (const { path, bytes: content } of inside) given.push({ path, blob: new Blob([content]) });
      if (other.length > MAX_TOLD) uncounted.push({ source, count: other.length });
      else for (const path of other) passedOver.push(sourceOf(path, 0));
    } catch (error) {
      diagnostics.push(
        error instanceof ZipRefusal
          ? withoutPlace('error', 'zip-refused', `The zip was not unpacked: ${error.message}.`, source.name)
          : unreadable(source, error),
      );
    }
  }
  return { given, passedOver, uncounted };
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

function skipped({ name }: SourceFile, message: string, severity: 'info' | 'warning'): Diagnostic {
  return withoutPlace(severity, 'format-unknown', message, name, 'skipped');
}
