/**
 * What the page changed in the text of a file, and what is edited in the text itself, for the tab *Source*. Both are
 * read and written in the worker.
 */
import type { Store } from '../edit/store.ts';
import { adoptSkinFacts } from '../evaluate/bounds.ts';
import { hasErrors } from '../model/diagnostic.ts';
import type { Character, Document } from '../model/document.ts';
import type { SourceFile } from '../model/files.ts';
import { openFiles } from '../project/open/open-files.ts';
import { type Owned, ownedIn } from '../project/save/owned.ts';
import { poseToSave } from '../project/save/saved-poses.ts';
import { bytes as inWords } from '../ui/kit/number-text.ts';
import type { CheckedText, FileChanges, TextEdits } from '../ui/state/source.ts';
import type { Runs } from '../worker/client.ts';
import type { CheckOutput, SourceInput } from '../worker/protocol.ts';
import { showingTheSame } from './opening.ts';
import type { Unsaved } from './unsaved.ts';

/** Longer files aren’t compared: one of this size takes 1 to 2 s. */
export const MAX_COMPARED_BYTES = 5_000_000;

export interface FileEditsParts {
  readonly store: Store;
  readonly unsaved: Pick<Unsaved, 'poseInFile'>;
  readonly worker: Runs<'changes'> & Runs<'check'>;
  /** Where the text of a path is. */
  find(path: string): Promise<SourceInput>;
}

export class FileEdits implements TextEdits {
  constructor(private readonly parts: FileEditsParts) {}

  async changes(path: string): Promise<FileChanges> {
    const { store, worker } = this.parts;
    const owned = this.owned(store.document, path);
    const source = owned[0]?.part.file;
    // Nothing is saved there.
    if (!source) return { hunks: [] };
    const file = await this.parts.find(path);
    // A file in a zip is unpacked by the worker.
    const bytes = file.inside === undefined ? file.blob.size : source.bytes;
    if (bytes > MAX_COMPARED_BYTES) {
      throw new Error(
        `Changes are shown in files up to ${inWords(MAX_COMPARED_BYTES)}; this one has ${inWords(bytes)}.`,
      );
    }
    return worker.run('changes', { file, source, owned: owned.map(alone) });
  }

  async check(path: string, edited: string, base: string): Promise<CheckedText> {
    const { store, worker } = this.parts;
    const owned = this.owned(store.document, path);
    const source = owned[0]?.part.file;
    if (!source) throw new Error('Nothing in the page is saved in this file any more.');
    const output = await worker.run('check', { source, edited, base, owned: owned.map(alone) });
    const fitted = hasErrors(output.diagnostics) ? [] : this.open(path, source, output).diagnostics;
    const diagnostics = [...output.diagnostics, ...fitted];
    const { isSame } = output;
    if (hasErrors(diagnostics)) return { diagnostics, isSame };
    return { diagnostics, isSame, apply: () => this.apply(path, source, output) };
  }

  /** In place of the parts from the path, as when a file is opened again; false if the document has changed too much. */
  private apply(path: string, source: SourceFile, output: CheckOutput): boolean {
    const { store } = this.parts;
    store.settle();
    const { document, diagnostics, opened } = this.open(path, source, output);
    if (hasErrors(diagnostics) || opened.length === 0) return false;
    for (const { skin, facts, morphs } of output.facts) adoptSkinFacts(skin, facts, morphs);
    store.replace(`Edit text of ${source.name}`, { document: showingTheSame(store.document, document) });
    return true;
  }

  private open(path: string, source: SourceFile, { files }: CheckOutput) {
    const { document, selection } = this.parts.store;
    const [first] = this.owned(document, path);
    // The very source: what was opened from it is known by it.
    const read = files.map((file) => ({ ...file, source }));
    // The example is edited, not replaced.
    return openFiles({ ...document, isOpeningSample: false }, read, [], first?.character.id ?? selection.characterId);
  }

  private owned(document: Document, path: string): readonly Owned[] {
    const { unsaved } = this.parts;
    return ownedIn(document, path, (character) => poseToSave(character, unsaved.poseInFile(character)));
  }
}

/** Without all that writing the part needs nothing of, to be sent to the worker. */
function alone({ character, part, pose }: Owned): Owned {
  const { driver: _driver, parts: _parts, poses: _poses, ...rest } = character;
  const bare: Character = { ...rest, skins: [], shownSkin: 0, morphs: [], clips: [], shownClip: -1, textures: [] };
  return { character: bare, part, pose };
}
