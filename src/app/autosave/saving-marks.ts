/** The session's state of saving: which parts equal their files, and where those files are. */

import type { ReviewState } from '../../ui/state/review.ts';
import type { DiskHandles, KeptDiskFile } from '../disk-handles.ts';
import type { Unsaved } from '../unsaved.ts';
import type { SavingMarks } from './autosave.ts';
import type { KeptMarks } from './session-state.ts';

export function savingMarks(unsaved: Unsaved, handles: DiskHandles, review: ReviewState): SavingMarks {
  return {
    snapshot: (document): KeptMarks => ({
      saved: unsaved.snapshot(document),
      disk: handles.entries().flatMap(keptFile),
      review: [...review.saved.get()].map(([path, said]) => ({ ...said, path })),
    }),
    restore(kept) {
      // Written by `snapshot`, or undefined.
      const { saved, disk, review: said } = (kept ?? {}) as Partial<KeptMarks>;
      if (saved) unsaved.restore(saved);
      if (disk) handles.restore(disk);
      if (said) review.areSaved(said);
    },
    subscribe: (listener) => {
      unsaved.parts.subscribe(listener);
      review.saved.subscribe(listener);
    },
  };
}

/** A file without a handle or address can't be read again from anywhere. */
function keptFile([key, { file: _, ...rest }]: KeptDiskFile): readonly KeptDiskFile[] {
  return rest.handle || rest.address !== undefined ? [[key, rest]] : [];
}
