/** What the menus can do with files, over dialogs, drops, samples and downloads. */
import type { Store } from '../edit/store.ts';
import { download } from '../io/download.ts';
import { fromDataTransfer, fromFileList } from '../io/given.ts';
import { findCharacter } from '../model/document.ts';
import type { Messages } from '../ui/messages.ts';
import type { FileActions, SampleEntry } from '../ui/workbench.ts';
import type { Opener } from './opening.ts';
import { fetchSample, type Sample } from './samples.ts';
import { saveCharacter, zipCharacter } from './saving.ts';

interface Parts {
  readonly store: Store;
  readonly messages: Messages;
  readonly opener: Opener;
  readonly samples: Promise<readonly Sample[]>;
}

export function fileActions({ store, messages, opener, samples }: Parts): FileActions {
  let listed: readonly SampleEntry[] = [];
  samples.then((list) => {
    listed = list;
  });
  const pick = (configure: (input: HTMLInputElement) => void) => {
    const input = document.createElement('input');
    input.type = 'file';
    input.multiple = true;
    configure(input);
    input.addEventListener('change', () => opener.open(() => fromFileList(input.files ?? [])));
    input.click();
  };
  const take = (data: DataTransfer) => {
    // Begun before anything is waited for: the browser takes the files back when the event is over.
    const files = fromDataTransfer(data);
    return opener.open(() => files);
  };
  return {
    open: () => pick(() => undefined),
    openFolder: () =>
      pick((input) => {
        input.webkitdirectory = true;
      }),
    openSample(id) {
      opener.open(async (signal) => {
        const sample = (await samples).find((s) => s.id === id);
        if (!sample) throw new Error(`There is no sample "${id}".`);
        return fetchSample(sample, document.baseURI, signal);
      });
    },
    get samples() {
      return listed;
    },
    drop: take,
    paste: take,
    saveAll(characterId) {
      const character = findCharacter(store.document, characterId);
      if (!character) return;
      const { name, bytes } = zipCharacter(character);
      download(name, bytes);
      messages.note(`Saved ${name}.`);
    },
    save(characterId, kind) {
      const character = findCharacter(store.document, characterId);
      const saved = character ? saveCharacter(character, kind) : [];
      for (const { name, text, diagnostics } of saved) {
        download(name, text);
        messages.report(diagnostics);
      }
      if (saved.length) messages.note(`Saved ${saved.map((f) => f.name).join(', ')}.`);
      else
        messages.note(`${character?.name ?? 'The character'} has nothing that could be saved as .${kind}.`, 'warning');
    },
  };
}
