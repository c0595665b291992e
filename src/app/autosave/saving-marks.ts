/** What saving knows of the session: which parts are as their files have them, and where the files lie. */
import type { Store } from '../../edit/store.ts';
import { findCharacter } from '../../model/document.ts';
import type { DiskHandles, KeptDiskFile } from '../disk-handles.ts';
import type { SavedMarks, Unsaved } from '../unsaved.ts';
import type { SavingMarks } from './autosave.ts';

interface Kept {
  readonly marks: SavedMarks;
  readonly disk: readonly KeptDiskFile[];
}

export function savingMarks(store: Store, unsaved: Unsaved, handles: DiskHandles): SavingMarks {
  return {
    snapshot(): Kept {
      const { document } = store;
      const marks = unsaved.snapshot();
      return {
        // Of characters that are gone only undo knows, which is not kept.
        marks: { ...marks, characters: marks.characters.filter((c) => findCharacter(document, c.characterId)) },
        disk: handles.entries().flatMap(keptFile),
      };
    },
    restore(kept) {
      // Our own snapshot, or none.
      const { marks, disk } = (kept ?? {}) as Partial<Kept>;
      if (marks) unsaved.restore(marks);
      if (disk) handles.restore(disk);
    },
    subscribe: (listener) => {
      unsaved.parts.subscribe(listener);
    },
  };
}

/** A file without a handle or address can only be read as it was, which is no place to read it anew from. */
function keptFile([key, { file: _, ...rest }]: KeptDiskFile): readonly KeptDiskFile[] {
  return rest.handle || rest.address !== undefined ? [[key, rest]] : [];
}
