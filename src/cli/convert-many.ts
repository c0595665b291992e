/**
 * `marrow convert FILE… --to KIND`: converts everything given to another format, each file next to its source or at the
 * same path below another folder. Those in a zip go to a folder with its name.
 *
 * Motion capture is read one file at a time, so that memory is bounded by the largest take; all other files are read
 * together, since a skeleton and its takes are separate files. Broken files are reported and skipped.
 */
import { existsSync } from 'node:fs';
import { basename, dirname, join, relative, resolve, sep } from 'node:path';
import { setImmediate as nextTurn } from 'node:timers/promises';
import { CommandError } from '../edit/command-error.ts';
import { openFiles } from '../files/open/open-files.ts';
import {
  outputsOf,
  refusal,
  renamedTo,
  sourceFor,
  type Target,
  targetObstacle,
  withOwnNames,
} from '../files/save/conversion.ts';
import type { ConversionOptions } from '../files/save/copies.ts';
import { unitNotKept } from '../files/save/unit-not-kept.ts';
import { type Diagnostic, hasErrors, withoutPlace } from '../model/diagnostic.ts';
import { type Character, EMPTY_DOCUMENT } from '../model/document.ts';
import { DistinctNames } from '../model/names/distinct-names.ts';
import { findFiles, loadFound } from './load.ts';
import { type GivenPath, isFolder, namedPaths } from './paths.ts';
import { openedTogether } from './together.ts';
import { writeInFolder } from './write-output.ts';
import { unpackedPath } from './zips.ts';

export interface ManyOptions extends ConversionOptions {
  readonly target: Target;
  /** Output folder; absent: next to the source. */
  readonly out?: string;
  /** Whether existing files may be overwritten. */
  readonly replaces: boolean;
}

/** One file written. */
export interface WrittenFile {
  /** Relative to the caller's folder. */
  readonly path: string;
  readonly bytes: number;
  /** The source files. */
  readonly from: readonly string[];
}

export interface ConversionProgress {
  written(file: WrittenFile): void | Promise<void>;
  told(diagnostics: readonly Diagnostic[]): void;
}

/**
 * @param args files, folders and zips, relative to `folder`
 * @returns whether everything could be converted
 */
export async function convertMany(
  args: readonly string[],
  folder: string,
  options: ManyOptions,
  progress: ConversionProgress,
): Promise<boolean> {
  const { files, problems } = findFiles(args, folder);
  const many = new Many(args, files, folder, options, progress);
  const groups = openedTogether(files, namedPaths(args, folder));
  if (problems.length) many.tell(problems);
  many.isOfMany = groups.length > 1;
  for (const group of groups) {
    await many.convert(group);
    // Signals are heard only then.
    await nextTurn();
  }
  many.tellKept();
  many.tellUnits();
  if (groups.length === 0 && problems.length === 0) {
    many.tell([refusal('nothing-to-convert', 'There is nothing to convert here.', args.join(' '))]);
  }
  return !many.hasFailed;
}

class Many {
  hasFailed = false;
  /** Whether the files of several characters may go to one folder. */
  isOfMany = false;
  /** Sources that are of the target's kind already, relative to the caller's folder. */
  private readonly kept: string[] = [];
  /** Characters whose files state a unit, in text that doesn't. */
  private readonly unitless: Character[] = [];
  /** Paths written in this run: two sources of one name don't overwrite each other's output. */
  private readonly done = new Set<string>();
  /** Names of characters by the folder that their files are written to. */
  private readonly named = new Map<string, DistinctNames>();
  private readonly folders: readonly string[];
  /** Files of archives by their absolute paths. */
  private readonly packed: ReadonlyMap<string, GivenPath>;

  constructor(
    args: readonly string[],
    private readonly files: readonly GivenPath[],
    private readonly folder: string,
    private readonly options: ManyOptions,
    private readonly progress: ConversionProgress,
  ) {
    this.folders = args.map((arg) => resolve(folder, arg)).filter(isFolder);
    this.packed = new Map(files.filter(({ zip }) => zip !== undefined).map((file) => [file.absolute, file]));
  }

  tell(diagnostics: readonly Diagnostic[]): void {
    if (hasErrors(diagnostics)) this.hasFailed = true;
    if (diagnostics.length) this.progress.told(diagnostics);
  }

  async convert(files: readonly GivenPath[]): Promise<void> {
    const loaded = await loadFound(files, this.folder, this.files);
    const { document, diagnostics } = openFiles(EMPTY_DOCUMENT, loaded.files, loaded.broken);
    this.tell([...loaded.diagnostics, ...diagnostics]);
    const { characters } = document;
    for (const character of characters) {
      if (character.skeleton || character.takes.length === 0) continue;
      const [source] = character.sources;
      const message = 'An animation alone has no joints. Add its skeleton.';
      this.tell([refusal('skeleton-missing', message, source?.path ?? character.name)]);
    }
    for (const character of characters) {
      const why = character.skeleton && targetObstacle(character, this.options.target);
      if (why !== undefined) this.tell([refusal('bones-missing', why, character.sources[0]?.path ?? character.name)]);
    }
    const posed = characters.filter(
      (character) => character.skeleton && targetObstacle(character, this.options.target) === undefined,
    );
    // Roots of one file stay in one file.
    if (posed.length > 1) this.isOfMany = true;
    const groups = posed.length > 1 && files.length === 1 ? [posed] : posed.map((character) => [character]);
    for (const group of groups) {
      try {
        await this.write(group);
      } catch (error) {
        if (!(error instanceof CommandError)) throw error;
        this.tell([refusal('conversion-refused', error.message, group[0].sources[0]?.path ?? group[0].name)]);
      }
    }
  }

  private async write(characters: readonly Character[]): Promise<void> {
    const { options, folder } = this;
    const named = characters.map((character) => this.withNames(character));
    let isWritten = false;
    for (const output of outputsOf(named, options.target, options)) {
      const stem = output.name.slice(0, output.name.lastIndexOf('.'));
      const source = sourceFor(named[0], stem);
      const read = source ? resolve(folder, source.path) : folder;
      const path = join(this.folderFor(read), fileSystemName(output.name));
      if (path === read && !options.replaces && !this.changesSources) {
        this.kept.push(relative(folder, path));
        continue;
      }
      const obstacle = this.obstacle(path, read);
      if (obstacle) {
        this.tell([refusal('file-exists', obstacle, relative(folder, path))]);
        continue;
      }
      this.done.add(key(path));
      const written = writeInFolder(path, output.pieces());
      this.tell(output.diagnostics());
      if ('failure' in written) {
        const message = `The file could not be written: ${written.failure}.`;
        this.tell([refusal('file-not-written', message, output.name)]);
      } else {
        isWritten = true;
        const from = characters.flatMap((character) => character.sources.map((s) => s.path));
        const shown = relative(folder, path).split(sep).join('/');
        await this.progress.written({ path: shown, bytes: written.bytes, from: [...new Set(from)] });
      }
    }
    if (isWritten) this.unitless.push(...characters.filter((character) => unitNotKept(character) !== undefined));
  }

  /** As its files are named: apart from others in their folder, and its takes and parts after it. */
  private withNames(character: Character): Character {
    const { sources, skeleton } = character;
    const [source] = sources;
    const out = this.folderFor(source ? resolve(this.folder, source.path) : this.folder);
    const names = this.named.get(out) ?? new DistinctNames();
    this.named.set(out, names);
    const name = names.add(skeleton?.name ?? character.name);
    const apart = skeleton && name !== skeleton.name ? renamedTo(character, skeleton, name) : character;
    return this.isOfMany ? withOwnNames(apart, this.options.target) : apart;
  }

  /** Without --out, files that are of the target's kind already stay as they are, which is said in one line. */
  tellKept(): void {
    const [first] = this.kept;
    if (first === undefined) return;
    const kind = `.${this.options.target}`;
    const message =
      this.kept.length === 1
        ? `This is already a ${kind} file and is left as it is; --out FOLDER rewrites it.`
        : `${this.kept.length} files are already ${kind} files and are left as they are; --out FOLDER rewrites them.`;
    this.tell([withoutPlace('info', 'source-kept', message, first)]);
  }

  /** Once for all: folders of one program have one unit. */
  tellUnits(): void {
    const [first] = this.unitless;
    const message = first && unitNotKept(first);
    if (message === undefined) return;
    const others = this.unitless.length - 1;
    const more = others > 0 ? ` The same goes for ${others} more.` : '';
    this.tell([withoutPlace('info', 'unit-not-kept', `${message}${more}`, first.sources[0]?.path ?? first.name)]);
  }

  /** Another frame rate makes other samples of a capture, also in its own format. */
  private get changesSources(): boolean {
    return this.options.target === 'bvh' && this.options.framesPerSecond !== undefined;
  }

  private obstacle(path: string, read: string): string | undefined {
    if (this.done.has(key(path))) return 'Another file of this name was just written; skipped.';
    if (this.options.replaces || !existsSync(path)) return undefined;
    if (path === read)
      return 'This would overwrite the file. Use --out FOLDER to write elsewhere, or --force to overwrite.';
    return 'A file of this name already exists. Use --force to overwrite it.';
  }

  /** Next to the source, or at the same path below the output folder. */
  private folderFor(read: string): string {
    const { out } = this.options;
    const packed = this.packed.get(read);
    const own = dirname(packed ? unpackedPath(packed) : read);
    if (out === undefined) return own;
    const target = resolve(this.folder, out);
    const named = this.folders.find((f) => own === f || own.startsWith(f + sep));
    const given = named ?? (packed?.zip === undefined ? undefined : dirname(packed.zip));
    return given === undefined ? target : join(target, relative(given, own));
  }
}

/** For file systems that ignore case. */
function key(path: string): string {
  return path.toLowerCase();
}

/** A take's name is free text; characters that separate folders are replaced. */
function fileSystemName(name: string): string {
  return basename(name.replace(/[/\\:\0]/g, '_'));
}
