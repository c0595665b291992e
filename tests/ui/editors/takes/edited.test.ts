import { describe, expect, it } from 'vitest';
import { takesToEdit, takesToInsert, takesToJoin } from '../../../../src/ui/editors/takes/edited.ts';
import { takeKey } from '../../../../src/ui/editors/takes/rows.ts';
import { character, clip, documentOf, workbench } from '../../builders.ts';

const ref = (clip: number, characterId = 'c1') => ({ characterId, clip });

describe('which takes are edited', () => {
  it('several selected takes are edited together, else the one that the current character plays', () => {
    const walker = character({ clips: [clip([0, 1]), { ...clip([0, 2]), name: 'run' }], shownClip: 1 });
    const { wb } = workbench(documentOf(walker));
    expect(takesToEdit(wb)).toEqual([ref(1)]);
    wb.timeline.takes.change({ chosen: new Set([takeKey(ref(0))]) });
    expect(takesToEdit(wb)).toEqual([ref(1)]);
    wb.timeline.takes.change({ chosen: new Set([takeKey(ref(0)), takeKey(ref(1))]) });
    expect(takesToEdit(wb).map(({ clip: index }) => index)).toEqual([0, 1]);
  });

  it('the only two takes are joined without being selected, and all but the current can be inserted into it', () => {
    const walker = character({ clips: [clip([0, 1]), { ...clip([0, 2]), name: 'run' }], shownClip: 1 });
    const { wb } = workbench(documentOf(walker));
    expect(takesToJoin(wb).map(({ clip: index }) => index)).toEqual([0, 1]);
    expect(takesToInsert(wb).map(({ clip: index }) => index)).toEqual([0]);
    expect(takesToJoin(workbench(documentOf(character({ clips: [clip([0, 1])] }))).wb)).toEqual([]);
  });
});
