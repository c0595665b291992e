/**
 * `marrow convert FILE… --to KIND`: everything given, into another format, each file beside the one that it came from or
 * in the same place below another folder.
 *
 * Motion capture is read one file at a time, so that a folder of any size takes no more memory than its largest take;
 * all other files are read together, for a skeleton and its clips are several. What is broken is reported, and the rest
 * goes on.
 */
import { mkdirSync, statSync } from 'node:fs';
import { basename, dirname, join, relative, resolve, sep } from 'node:path';
import { CommandError } from '../edit/store.ts';
import { type Diagnostic, hasErrors } from '../model/diagnostic.ts';
import { type Character, EMPTY_DOCUMENT } from '../model/document.ts';
import { openFiles } from '../project/open/open-files.ts';
import { formatOf } from '../project/open/readers.ts';
import { type ConversionOptions, outputsOf, refusal, sourceFor, type Target } from '../project/save/conversion.ts';
import { loadFiles } from './load.ts';
import { findGiven, type GivenPath } from './paths.ts';
import { writeOutput } from './write-output.ts';

export interface ManyOptions extends ConversionOptions {
  readonly target: Target;
  /** Folder for all that is written; absent: beside what was read. */
  readonly out?: string;
  /** Whether a file that is there may be replaced. */
  readonly replaces: boolean;
}

/** One file written. */
export interface WrittenFile {
  /** From the caller's folder. */
  readonly path: string;
  readonly bytes: number;
  /** The files that it was made of. */
  readonly from: readonly string[];
}

export interface ConversionProgress {
  written(file: WrittenFile): void | Promise<void>;
  told(diagnostics: readonly Diagnostic[]): void;
}

/**
 * @param args files and folders, relative to `folder`
 * @returns whether everything could be converted
 */
export async function convertMany(
  args: readonly string[],
  folder: string,
  options: ManyOptions,
  progress: ConversionProgress,
): Promise<boolean> {
  const { files, missing } = findGiven(args, folder);
  const many = new Many(args, folder, options, progress);
  // Of the rest, only what takes part: a folder holds read-mes and pictures too.
  const [takes, others] = [files.filter(isBvh), files.filter((file) => !isBvh(file) && formatOf(file.absolute))];
  const groups = [...takes.map((take) => [take.path]), others.map(({ path }) => path)].filter((g) => g.length > 0);
  if (missing.length) many.tell(loadFiles(missing, folder).diagnostics);
  for (const group of groups) await many.convert(group);
  if (groups.length === 0 && missing.length === 0) {
    many.tell([refusal('nothing-to-convert', 'There is no file here to convert.', args.join(' '))]);
  }
  return !many.hasFailed;
}

function isBvh({ absolute }: GivenPath): boolean {
  return formatOf(absolute)?.kind === 'bvh';
}

class Many {
  hasFailed = false;
  /** Paths of this run: two files of one name are not written over each other. */
  private readonly done = new Set<string>();
  private readonly folders: readonly string[];

  constructor(
    args: readonly string[],
    private readonly folder: string,
    private readonly options: ManyOptions,
    private readonly progress: ConversionProgress,
  ) {
    this.folders = args
      .map((arg) => resolve(folder, arg))
      .filter((path) => statSync(path, { throwIfNoEntry: false })?.isDirectory());
  }

  tell(diagnostics: readonly Diagnostic[]): void {
    if (hasErrors(diagnostics)) this.hasFailed = true;
    if (diagnostics.length) this.progress.told(diagnostics);
  }

  async convert(paths: readonly string[]): Promise<void> {
    const loaded = loadFiles(paths, this.folder);
    const { document, diagnostics } = openFiles(EMPTY_DOCUMENT, loaded.files, loaded.broken);
    this.tell([...loaded.diagnostics, ...diagnostics]);
    const { characters } = document;
    for (const character of characters) {
      if (character.skeleton || character.clips.length === 0) continue;
      const [source] = character.sources;
      const message = 'An animation alone has no joints. Give its skeleton too.';
      this.tell([refusal('skeleton-missing', message, source?.name ?? character.name)]);
    }
    const posed = characters.filter(({ skeleton }) => skeleton);
    // Roots of one file go together.
    const groups = posed.length > 1 && paths.length === 1 ? [posed] : posed.map((character) => [character]);
    for (const group of groups) {
      try {
        await this.write(group);
      } catch (error) {
        if (!(error instanceof CommandError)) throw error;
        this.tell([refusal('conversion-refused', error.message, group[0].sources[0]?.name ?? group[0].name)]);
      }
    }
  }

  private async write(characters: readonly Character[]): Promise<void> {
    const { options, folder } = this;
    for (const output of outputsOf(characters, options.target, options)) {
      const stem = output.name.slice(0, output.name.lastIndexOf('.'));
      const source = sourceFor(characters[0], stem);
      const read = source ? resolve(folder, source.path) : folder;
      const path = join(this.folderFor(read), fileSystemName(output.name));
      if (path === read && !options.replaces) continue;
      const obstacle = this.obstacle(path);
      if (obstacle) {
        this.tell([refusal('file-exists', obstacle, relative(folder, path))]);
        continue;
      }
      this.done.add(path);
      mkdirSync(dirname(path), { recursive: true });
      const written = writeOutput(path, output.pieces());
      this.tell(output.diagnostics());
      if ('failure' in written) {
        const message = `The file could not be written: ${written.failure}.`;
        this.tell([refusal('file-not-written', message, output.name)]);
      } else {
        const from = characters.flatMap((character) => character.sources.map((s) => s.path));
        const shown = relative(folder, path).split(sep).join('/');
        await this.progress.written({ path: shown, bytes: written.bytes, from: [...new Set(from)] });
      }
    }
  }

  private obstacle(path: string): string | undefined {
    if (this.done.has(path)) return 'Another file of this name was just written; left as it is.';
    if (this.options.replaces || !statSync(path, { throwIfNoEntry: false })) return undefined;
    return 'A file of this name already exists; --force replaces it.';
  }

  /** Beside what was read, or at the same place below the folder asked for. */
  private folderFor(read: string): string {
    const { out } = this.options;
    const own = dirname(read);
    if (out === undefined) return own;
    const target = resolve(this.folder, out);
    const given = this.folders.find((f) => own === f || own.startsWith(f + sep));
    return given === undefined ? target : join(target, relative(given, own));
  }
}

/** A clip's name may be anything; what would lead to another folder is no part of it. */
function fileSystemName(name: string): string {
  return basename(name.replace(/[/\\:\0]/g, '_'));
}
