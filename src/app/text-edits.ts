/**
 * What the page changed in the text of a file, and what is edited in the text itself, for the tab *Source*. Both are
 * read and written in the worker.
 */
import type { Store } from '../edit/store.ts';
import { adoptSkinFacts } from '../evaluate/skin/bounds.ts';
import { openFiles } from '../files/open/open-files.ts';
import { type Owned, ownedIn } from '../files/save/owned.ts';
import { poseToSave } from '../files/save/saved-poses.ts';
import { hasErrors } from '../model/diagnostic.ts';
import type { Character, Document } from '../model/document.ts';
import { baseName, type SourceFile } from '../model/files.ts';
import { NO_MARKS } from '../model/part.ts';
import type { Messages } from '../ui/state/messages.ts';
import { type CheckedText, type FileChanges, MAX_TEXT_BYTES, type TextEdits } from '../ui/state/source.ts';
import { bytes as inWords } from '../ui/widgets/numbers/number-text.ts';
import type { Runs } from '../worker/client.ts';
import type { CheckOutput } from '../worker/protocol.ts';
import { type Opener, showingTheSame } from './opening.ts';
import type { SourceTexts } from './source-texts.ts';
import type { Unsaved } from './unsaved.ts';

export interface FileEditsParts {
  readonly store: Store;
  readonly messages: Pick<Messages, 'report'>;
  readonly opener: Pick<Opener, 'put'>;
  readonly unsaved: Pick<Unsaved, 'poseInFile'>;
  readonly worker: Runs<'changes' | 'check'>;
  readonly texts: Pick<SourceTexts, 'find' | 'given' | 'opened' | 'noteWritten'>;
}

export class FileEdits implements TextEdits {
  constructor(private readonly parts: FileEditsParts) {}

  async changes(path: string): Promise<FileChanges> {
    const { store, worker } = this.parts;
    const owned = this.owned(store.document, path);
    const source = owned[0]?.part.file;
    // Nothing is saved there.
    if (!source) return { hunks: [] };
    const file = await this.parts.texts.find(path, forever);
    // A file in a zip is unpacked by the worker.
    const bytes = file.inside === undefined ? file.blob.size : source.bytes;
    if (bytes > MAX_TEXT_BYTES) {
      throw new Error(
        `Changes can be shown in files of up to ${inWords(MAX_TEXT_BYTES)}; this one has ${inWords(bytes)}.`,
      );
    }
    return worker.run('changes', { file, source, owned: owned.map(alone) });
  }

  async check(path: string, edited: string, base: string): Promise<CheckedText> {
    const { store, worker, texts } = this.parts;
    const owned = this.owned(store.document, path);
    const own = owned[0]?.part.file;
    // The very source: what was opened from it is known by it. A text with errors wasn't opened.
    const isOpen = own !== undefined && texts.opened(own)?.given === texts.given(path);
    const source = isOpen ? own : { name: baseName(path), path, bytes: edited.length };
    const output = await worker.run('check', { source, edited, base, owned: owned.map(alone) });
    const fitted = hasErrors(output.diagnostics) ? [] : this.open(path, source, output).diagnostics;
    const diagnostics = [...output.diagnostics, ...fitted];
    const { isSame } = output;
    if (hasErrors(diagnostics)) return { diagnostics, isSame };
    return {
      diagnostics,
      isSame,
      apply: () => (isOpen ? this.replace(path, source, output) : this.add(source, output, edited)),
    };
  }

  /** In place of the parts from the path, as when a file is opened again; false if that doesn't fit any more. */
  private replace(path: string, source: SourceFile, output: CheckOutput): boolean {
    const { store } = this.parts;
    store.settle();
    const { document, diagnostics, opened } = this.open(path, source, output);
    if (hasErrors(diagnostics) || opened.length === 0) return false;
    adoptFacts(output);
    store.replace(labelOf(source), { document: showingTheSame(store.document, document) });
    return true;
  }

  /** Opens a text that had errors before, and so is nowhere else. */
  private add(source: SourceFile, output: CheckOutput, edited: string): boolean {
    const { store, opener, texts, messages } = this.parts;
    store.settle();
    const { document, diagnostics, opened } = this.open(source.path, source, output);
    if (hasErrors(diagnostics) || opened.length === 0) return false;
    adoptFacts(output);
    opener.put(document, opened, labelOf(source));
    texts.noteWritten(source.path, new Blob([edited]), store.document);
    messages.report([], [source.name]);
    return true;
  }

  private open(path: string, source: SourceFile, { files }: CheckOutput) {
    const { document, selection } = this.parts.store;
    const [first] = this.owned(document, path);
    const read = files.map((file) => ({ ...file, source }));
    // The example is edited, not replaced.
    const base = first ? { ...document, isOpeningSample: false } : document;
    return openFiles(base, read, [], first?.character.id ?? selection.characterId);
  }

  private owned(document: Document, path: string): readonly Owned[] {
    const { unsaved } = this.parts;
    return ownedIn(document, path, (character) => poseToSave(character, unsaved.poseInFile(character)));
  }
}

function labelOf({ name }: SourceFile): string {
  return `Edit text of ${name}`;
}

function adoptFacts({ facts }: CheckOutput): void {
  for (const { skin, facts: own, morphs } of facts) adoptSkinFacts(skin, own, morphs);
}

const forever = new AbortController().signal;

/** Without all that writing the part needs nothing of, to be sent to the worker. */
function alone({ character, part, pose }: Owned): Owned {
  const { driver: _driver, parts, poses: _poses, ...rest } = character;
  // A motion of Acclaim is read with its skeleton's file.
  const marks = { ...NO_MARKS, ...(parts?.skeleton && { skeleton: parts.skeleton }) };
  const bare: Character = {
    ...rest,
    parts: marks,
    skins: [],
    shownSkin: 0,
    morphs: [],
    takes: [],
    shownTake: -1,
    textures: [],
  };
  return { character: bare, part, pose };
}
