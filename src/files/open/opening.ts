/** An opening in progress: what is open by now, which files have been used, and what is said about them. */

import { type Diagnostic, withoutPlace } from '../../model/diagnostic.ts';
import { type Character, type Document, EMPTY_DOCUMENT, type UnusedFile } from '../../model/document.ts';
import type { BrokenFile, FileKind, FileNaming, ParsedFile, SourceFile } from '../../model/files.ts';
import { newCharacter } from '../../model/new-character.ts';
import { openingOf } from '../kinds.ts';
import { OpenCharacters } from './open-characters.ts';
import { OpenSpaces } from './open-spaces.ts';

/** Opens JSON beside another file (`beside-files.ts`). */
export type OpenBeside = (opening: Opening, file: ParsedFile) => void;

/** The state of one opening, which the steps of `open-in-steps.ts` add to. */
export class Opening {
  /**
   * The document without the opening example, which is replaced and never extended; it is kept only once it was changed,
   * or when nothing but poses is opened.
   */
  readonly base: Document;
  /** Files left unused earlier; these files may make them usable. */
  readonly waiting: readonly UnusedFile[];
  /** Textures of these files and of those that wait. */
  readonly textures: readonly ParsedFile[];
  readonly characters: OpenCharacters;
  readonly spaces: OpenSpaces;
  readonly diagnostics: Diagnostic[] = [];
  /** Ids of new and changed characters. */
  readonly opened = new Set<string>();
  readonly used = new Set<ParsedFile>();
  readonly unused: UnusedFile[] = [];
  private ids: number;

  /** Arguments as of `openFiles`. */
  constructor(
    readonly document: Document,
    readonly files: readonly ParsedFile[],
    readonly broken: readonly BrokenFile[],
    readonly selectedId: string | undefined,
    readonly called: FileNaming,
    readonly openBeside: OpenBeside | undefined,
  ) {
    const { unused, charactersMade, review } = document;
    const makesWay = document.isOpeningSample === true && !isForCharacters([...files, ...broken]);
    this.base = makesWay ? { ...EMPTY_DOCUMENT, unused, charactersMade, ...(review && { review }) } : document;
    this.characters = new OpenCharacters(this.base.characters);
    this.spaces = new OpenSpaces(this.base.characters, files);
    this.ids = charactersMade;
    const given = new Set(files.map(({ source }) => source.path));
    this.waiting = unused.filter(({ file }) => !given.has(file.source.path));
    this.textures = [...files, ...this.waiting.map((w) => w.file)].filter((f) => f.kind === 'texture');
  }

  /** Number of characters ever created. */
  get charactersMade(): number {
    return this.ids;
  }

  /** Ids are never reused, so that a selection or a view can't confuse two characters. */
  make(name: string): Character {
    return newCharacter(`c${++this.ids}`, name);
  }

  /** Leaves a file unused until another one is opened without errors. @param missing has errors, or does not fit */
  wait(file: ParsedFile, missing: SourceFile): void {
    const why = `It belongs with ${this.called(missing)}, which has errors.`;
    this.unused.push({ file, why, waitsFor: missing });
  }

  /** Adds a message about a whole file. */
  tell(severity: Diagnostic['severity'], code: string, message: string, source: SourceFile): void {
    this.diagnostics.push(withoutPlace(severity, code, message, this.called(source)));
  }
}

/** Whether the files are poses, dumps or beside others only, which show nothing by themselves. */
function isForCharacters(files: readonly { readonly kind: FileKind }[]): boolean {
  return files.length > 0 && files.every(({ kind }) => ['poses', 'dump', 'beside'].includes(openingOf(kind).as));
}
