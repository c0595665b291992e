/** Mirrors the selected takes, long ones in slices; if anything else changes meanwhile, the result is dropped. */
import { mirrorTakes, mirrorTakesSteps } from '../../../edit/commands/take-edits.ts';
import { EditPreview } from '../../../edit/edit-preview.ts';
import type { Uses } from '../../state/workbench.ts';
import { inSlices } from '../../widgets/in-slices.ts';
import { takesToEdit } from './edited.ts';

export function runMirror({ store, messages, timeline }: Uses<'store' | 'messages' | 'timeline'>): void {
  const takes = takesToEdit({ store, timeline });
  const label = mirrorTakes.label(store.document, { takes });
  const preview = new EditPreview(store, label, () => {
    messages.note(`${label} was stopped because the document has changed. Try again.`, 'warning');
  });
  inSlices(mirrorTakesSteps(preview.base, { takes }), {
    isOver: () => preview.over,
    progress: () => undefined,
    done(document) {
      if (document === preview.base) {
        preview.putBack();
        messages.note('Nothing to mirror: both sides already move alike.');
        return;
      }
      preview.show(document);
      preview.keep();
      messages.note(`${label.replace('Mirror', 'Mirrored')}: left and right are swapped.`);
    },
    failed(error) {
      preview.putBack();
      throw error;
    },
  });
}
