/**
 * Files from disk to models, through the same readers as in the page, a megabyte at a time: memory is bounded by the
 * model, not the file.
 */
import { readdirSync, statSync } from 'node:fs';
import { basename, dirname, isAbsolute, posix, relative, resolve, sep } from 'node:path';
import { unreadMessage } from '../files/foreign.ts';
import { joinLayers, type Keep, plainFilesIn } from '../files/open/layers.ts';
import { openFiles } from '../files/open/open-files.ts';
import type { OpenResult } from '../files/open/open-in-steps.ts';
import { type Format, formatOf } from '../files/readers.ts';
import { isWorthDiagnosing } from '../formats/diagnose/diagnose.ts';
import { foldUnreadable } from '../formats/diagnose/fold.ts';
import { sha256 } from '../formats/sha256.ts';
import type { Beside } from '../import/imported.ts';
import { type Diagnostic, hasErrors, withoutPlace } from '../model/diagnostic.ts';
import { type Character, EMPTY_DOCUMENT } from '../model/document.ts';
import { emptyDumpMessage, isEmptyDump } from '../model/dump.ts';
import {
  type BrokenFile,
  byPath,
  type FileContent,
  type FileKind,
  type ParsedFile,
  type SourceFile,
} from '../model/files.ts';
import { perObject } from '../model/per-object.ts';
import { findGiven, type GivenPath, isFile, type MissingPath } from './paths.ts';
import { fileBytes, readPieces } from './read-file.ts';
import { reasonOf } from './reason.ts';
import { withZipsUnpacked } from './zips.ts';

/** A file named on the command line, read or not. */
export interface LoadedFile {
  readonly name: string;
  /** Relative to the caller's folder, `/` between folders. */
  readonly path: string;
  /** By its name; `unknown` if Marrow doesn't read it. */
  readonly kind: FileKind | 'unknown';
  /** Absent if the file has errors. */
  readonly content?: FileContent;
}

export interface Loaded {
  /** In the order given. */
  readonly all: readonly LoadedFile[];
  readonly files: readonly ParsedFile[];
  /** With errors. */
  readonly broken: readonly BrokenFile[];
  readonly diagnostics: readonly Diagnostic[];
}

/** What arguments name. */
export interface FoundFiles {
  /** With those in zips. */
  readonly files: readonly GivenPath[];
  readonly missing: readonly MissingPath[];
  /** Problems with missing files, and with zips that can't be unpacked. */
  readonly problems: readonly Diagnostic[];
}

/** @param args files, folders and zips, relative to `folder` */
export function findFiles(args: readonly string[], folder: string): FoundFiles {
  const { files, missing } = findGiven(args, folder);
  const unpacked = withZipsUnpacked(files);
  const absent = missing.map(({ path, code, why }) => withoutPlace('error', code, why, path));
  return { files: unpacked.files, missing, problems: [...absent, ...unpacked.problems] };
}

/**
 * @param args files, folders and zips, relative to `folder`
 * @param otherwise the format of files whose names have none
 */
export function loadFiles(args: readonly string[], folder: string, otherwise?: Format): Loaded {
  return loadAll(findFiles(args, folder), otherwise);
}

/**
 * The files in a folder or a zip, of other programs too, with paths relative to it; tables are numbers.
 *
 * @param container absolute
 */
export async function loadInside(container: string): Promise<Loaded> {
  if (!isFile(container)) return loadAny(['.'], container, { asNumbers: true });
  const name = basename(container);
  const found = findFiles([name], dirname(container));
  const files = found.files.map((file) => ({ ...file, path: file.path.slice(name.length + 1) }));
  return loadAll({ ...found, files }, undefined, await importGiven(files.filter(isNoTable), dirname(container), files));
}

function loadAll(
  { files, missing, problems }: FoundFiles,
  otherwise?: Format,
  imported?: ImportedPaths,
  keep?: Keep,
): Loaded {
  const found = loadGiven(files, otherwise, imported, keep);
  const absent = missing.map(({ path }): LoadedFile => ({ name: basename(path), path, kind: kindOf(path) }));
  const broken = absent.flatMap(({ name, path, kind }): BrokenFile[] =>
    kind === 'unknown' ? [] : [{ kind, source: { name, path, bytes: 0 } }],
  );
  return {
    all: [...absent, ...found.all],
    files: found.files,
    broken: [...broken, ...found.broken],
    diagnostics: [...problems, ...found.diagnostics],
  };
}

/** How files are loaded. */
export interface LoadOptions {
  /** The format of files whose names have none. */
  readonly otherwise?: Format;
  /** What counts of takes with layers that were edited. */
  readonly keep?: Keep;
  /** Whether tables of points are numbers to be compared, as any other table is. */
  readonly asNumbers?: boolean;
}

/**
 * As `loadFiles`, and files of other programs too, whose readers are fetched and look for further files.
 */
export async function loadAny(
  args: readonly string[],
  folder: string,
  { otherwise, keep, asNumbers }: LoadOptions = {},
): Promise<Loaded> {
  const found = findFiles(args, folder);
  const imported = await importGiven(asNumbers ? found.files.filter(isNoTable) : found.files, folder, found.files);
  return loadAll(found, otherwise, imported, keep);
}

function isNoTable({ path }: GivenPath): boolean {
  return formatOf(basename(path))?.kind !== 'dump';
}

/**
 * As `loadAny`, of files that were found already.
 *
 * @param near where those of an archive look for further files
 * @param spare further files for those that find none of their kind
 */
export async function loadFound(
  given: readonly GivenPath[],
  folder: string,
  near = given,
  spare: readonly Beside[] = [],
): Promise<Loaded> {
  return loadGiven(given, undefined, await importGiven(given, folder, near, spare));
}

/** Files that were imported, and those that are parts of them, by their paths. */
type ImportedPaths = ReadonlyMap<string, LoadedOne | 'part'>;

async function importGiven(
  given: readonly GivenPath[],
  folder: string,
  near = given,
  spare: readonly Beside[] = [],
): Promise<ImportedPaths> {
  const out = new Map<string, LoadedOne | 'part'>();
  for (const file of given) {
    const { path, absolute, bytes: held } = file;
    const name = basename(path);
    const format = formatOf(name);
    if (!format?.imports) continue;
    try {
      const bytes = held ? new Uint8Array(held) : fileBytes(absolute);
      const { value, diagnostics, beside, isOther } = await format.imports({
        fileName: name,
        bytes,
        beside: async (wanted) =>
          (isFile(absolute) ? besideOnDisk(absolute, wanted, folder) : await besideInZip(file, wanted, near)) ??
          spare.find(({ source }) => source.name === wanted),
        near: (extension) => {
          const names = namesNear(file, extension, near);
          const others = spare.map(({ source }) => source.name).filter((other) => other.endsWith(`.${extension}`));
          return names.length > 0 ? names : others;
        },
      });
      if (isOther) continue;
      out.set(path, { bytes: bytes.length, diagnostics, ...(value && { content: value }), beside });
      for (const part of beside) out.set(part.path, 'part');
    } catch (error) {
      out.set(path, unreadable(name, error));
    }
  }
  return out;
}

/** A file next to another one on disk; names of other places, such as web addresses, are never looked up. */
function besideOnDisk(absolute: string, wanted: string, folder: string): Beside | undefined {
  if (isAbsolute(wanted) || /^[a-z][a-z0-9+.-]*:/i.test(wanted)) return undefined;
  const found = resolve(dirname(absolute), wanted);
  if (!isFile(found)) return undefined;
  const bytes = fileBytes(found);
  const path = relative(folder, found).split(sep).join('/');
  return { bytes, source: { name: basename(found), path, bytes: bytes.length } };
}

/**
 * Files with an extension that one may belong to, relative to it: those of its folder that were given, else all that
 * were given, else those that are in its folder on disk.
 */
function namesNear(
  { path, absolute, zip }: GivenPath,
  extension: string,
  near: readonly GivenPath[],
): readonly string[] {
  const given = near.filter((file) => file.zip === zip && file.path.toLowerCase().endsWith(`.${extension}`));
  const own = given.filter((file) => dirname(file.absolute) === dirname(absolute));
  const found = own.length > 0 ? own : given;
  if (found.length === 0 && isFile(absolute)) return namesOnDisk(dirname(absolute), extension);
  return found.map((file) =>
    zip === undefined
      ? relative(dirname(absolute), file.absolute).split(sep).join('/')
      : posix.relative(posix.dirname(path), file.path),
  );
}

/** Read once, however many takes a folder has. */
function namesOnDisk(folder: string, extension: string): readonly string[] {
  const key = `${folder} ${extension}`;
  const known = NAMES.get(key) ?? readdirSync(folder).filter((name) => name.toLowerCase().endsWith(`.${extension}`));
  NAMES.set(key, known);
  return known;
}

const NAMES = new Map<string, readonly string[]>();

/** For each archive, what finds its files. */
const findersIn = perObject(async (near: readonly GivenPath[]) => {
  const { besideIn } = await import('../files/imports.ts');
  const byZip = new Map<string | undefined, GivenPath[]>();
  for (const file of near) {
    const others = byZip.get(file.zip);
    if (others) others.push(file);
    else byZip.set(file.zip, [file]);
  }
  return new Map([...byZip].map(([zip, files]) => [zip, besideIn(files)]));
});

/** A file of the archive that this one is in. */
async function besideInZip(
  { path, zip }: GivenPath,
  wanted: string,
  near: readonly GivenPath[],
): Promise<Beside | undefined> {
  const found = (await findersIn(near)).get(zip)?.(path, wanted);
  if (!found?.bytes) return undefined;
  const bytes = new Uint8Array(found.bytes);
  return { bytes, source: { name: basename(found.path), path: found.path, bytes: bytes.length } };
}

/**
 * Reads files that were found, on disk or in archives; those of a take with layers become one.
 * @param otherwise as for `loadFiles`
 */
export function loadGiven(
  given: readonly GivenPath[],
  otherwise?: Format,
  imported?: ImportedPaths,
  keep: Keep = 'edit',
): Loaded {
  const all: LoadedFile[] = [];
  const files: ParsedFile[] = [];
  const broken: BrokenFile[] = [];
  const diagnostics: Diagnostic[] = [];
  for (const path of given) {
    const name = basename(path.path);
    const format = formatOf(name) ?? otherwise;
    const kind = format?.kind ?? 'unknown';
    const known = imported?.get(path.path);
    if (known === 'part') continue;
    const { content, bytes, diagnostics: found, beside } = known ?? loadOne(path, name, format);
    // Readers know the name alone, which files of many folders share.
    diagnostics.push(...found.map((diagnostic) => ({ ...diagnostic, file: path.path })));
    // A table may be one of points.
    all.push({ name, path: path.path, kind: content?.kind ?? kind, ...(content && { content }) });
    const source: SourceFile = { name, path: path.path, bytes };
    if (content && isEmptyDump(content)) diagnostics.push(withoutNumbers(path.path, bytes));
    else if (content) files.push({ ...content, source, ...(beside && { beside }) });
    else if (kind !== 'unknown') broken.push({ kind, source });
  }
  const joined = joinLayers(withHashes(files, given), keep, byPath);
  return { all, files: joined.files, broken, diagnostics: [...diagnostics, ...joined.diagnostics] };
}

/** The files with the hashes that others of them ask for. */
function withHashes(files: readonly ParsedFile[], given: readonly GivenPath[]): readonly ParsedFile[] {
  const asked = new Set(plainFilesIn(files));
  if (asked.size === 0) return files;
  return files.map((file) => {
    const path = asked.has(file) ? given.find(({ path }) => path === file.source.path) : undefined;
    return path ? { ...file, sha256: sha256(path.bytes ?? fileBytes(path.absolute)) } : file;
  });
}

interface LoadedOne {
  readonly content?: FileContent;
  readonly bytes: number;
  readonly diagnostics: readonly Diagnostic[];
  /** Other files that are in it. */
  readonly beside?: readonly SourceFile[];
}

function loadOne({ absolute, bytes: held }: GivenPath, name: string, format: Format | undefined): LoadedOne {
  try {
    const stats = held ? undefined : statSync(absolute);
    const size = held?.length ?? stats?.size ?? 0;
    if (!format) return { bytes: size, diagnostics: [unknownFormat(name)] };
    // A pipe is read once, and errors are told by its content.
    const own = stats?.isFile() === false ? fileBytes(absolute) : held;
    const bytes = own?.length ?? size;
    return { bytes, ...(own ? readBytes(own, name, format) : readFile(absolute, bytes, name, format)) };
  } catch (error) {
    return unreadable(name, error);
  }
}

function unreadable(name: string, error: unknown): LoadedOne {
  // Node names files in UTF-8, and puts this where a name isn't.
  const reason = name.includes('\ufffd') ? 'its name is not UTF-8; rename it' : reasonOf(error);
  const message = `The file could not be read: ${reason}.`;
  return { bytes: 0, diagnostics: [withoutPlace('error', 'file-unreadable', message, name)] };
}

function readFile(path: string, bytes: number, name: string, format: Format): Omit<LoadedOne, 'bytes'> {
  const reader = format.reader(name, bytes);
  readPieces(path, (piece) => reader.feed(piece));
  return ended(reader.end(), name, bytes, format, () => fileBytes(path));
}

function readBytes(bytes: Uint8Array, name: string, format: Format): Omit<LoadedOne, 'bytes'> {
  const reader = format.reader(name, bytes.length);
  reader.feed(bytes);
  return ended(reader.end(), name, bytes.length, format, () => bytes);
}

/** @param content all of it, for what is told about errors */
function ended(
  { value, diagnostics: told }: ReturnType<ReturnType<Format['reader']>['end']>,
  name: string,
  bytes: number,
  { diagnose }: Format,
  content: () => Uint8Array,
): Omit<LoadedOne, 'bytes'> {
  const isDiagnosed = diagnose && isWorthDiagnosing(told, bytes);
  const diagnostics = foldUnreadable(isDiagnosed ? diagnose(name, content(), told) : told);
  return value ? { content: value, diagnostics } : { diagnostics };
}

/** The characters of what was loaded; `diagnostics` are those of both. */
export function openLoaded({ files, broken, diagnostics }: Loaded): OpenResult {
  const opened = openFiles(EMPTY_DOCUMENT, files, broken, undefined, byPath);
  return { ...opened, diagnostics: [...diagnostics, ...opened.diagnostics] };
}

/** An error if none of the files could be read and no other says so, since a command that did nothing has failed. */
export function nothingRead({ all, files, diagnostics }: Loaded, args: readonly string[]): readonly Diagnostic[] {
  if (files.length > 0 || hasErrors(diagnostics)) return [];
  const [code, message] =
    all.length === 0
      ? ['nothing-found', 'There are no readable files here.']
      : ['nothing-read', 'Expected a file that Marrow reads, found none here.'];
  return [withoutPlace('error', code, message, args.join(' '))];
}

/** A skin alone does not move, and an animation alone moves nothing. */
export function withoutSkeleton(characters: readonly Character[]): Diagnostic[] {
  const others = characters.some(({ skeleton }) => skeleton);
  return characters.flatMap(({ name, skeleton, skins, sources }) => {
    if (skeleton) return [];
    const found = others
      ? 'Expected a skeleton whose name its own starts with, found several others. Name it after one of them, or give only that skeleton.'
      : 'Expected a skeleton with these files, found none.';
    const assumed = skins.length > 0 ? 'vertices are left as in the file' : 'channels alone, without joints';
    return [withoutPlace('info', 'skeleton-missing', found, sources[0]?.path ?? name, assumed)];
  });
}

function kindOf(name: string): FileKind | 'unknown' {
  return formatOf(name)?.kind ?? 'unknown';
}

/** A file that could be a dump by its name. */
function withoutNumbers(name: string, bytes: number): Diagnostic {
  return withoutPlace('warning', 'format-unknown', emptyDumpMessage(bytes), name, 'skipped');
}

function unknownFormat(name: string): Diagnostic {
  return withoutPlace('warning', 'format-unknown', unreadMessage(name), name, 'skipped');
}
