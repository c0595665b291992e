/** What saving knows of the session: which parts are as their files have them, and where the files lie. */
import type { DiskHandles, KeptDiskFile } from '../disk-handles.ts';
import type { Unsaved } from '../unsaved.ts';
import type { SavingMarks } from './autosave.ts';
import type { KeptMarks } from './session-state.ts';

export function savingMarks(unsaved: Unsaved, handles: DiskHandles): SavingMarks {
  return {
    snapshot: (): KeptMarks => ({ saved: unsaved.snapshot(), disk: handles.entries().flatMap(keptFile) }),
    restore(kept) {
      // Our own snapshot, or none.
      const { saved, disk } = (kept ?? {}) as Partial<KeptMarks>;
      if (saved) unsaved.restore(saved);
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
