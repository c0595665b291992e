/** A walker and a sword in its hand, and their files. */
import { addAttachment } from '../../../src/edit/commands/beside/attach.ts';
import { Store } from '../../../src/edit/store.ts';
import { changedFiles } from '../../../src/files/save/jobs.ts';
import { savedFileOf } from '../../../src/files/save/output.ts';
import { SavedParts } from '../../../src/files/save/saved-parts.ts';
import type { Document } from '../../../src/model/document.ts';
import { filePose } from '../../../src/model/skeleton/dofs.ts';
import { restChannel } from '../../../src/model/takes/take.ts';
import { channelOf } from '../../edit/keys/channels.ts';
import { character, documentOf, joint, skeleton } from '../../helpers/builders.ts';

export type Texts = ReadonlyMap<string, string>;

const turning = channelOf([
  [0, 0],
  [2, 3],
]);
const WALKER = character({
  name: 'walker',
  skeleton: skeleton(2, 'walker'),
  takes: [
    {
      name: 'walker_walk',
      range: [0, 2],
      channels: Array.from({ length: 9 }, (_, dof) => (dof === 0 || dof === 3 || dof === 7 ? turning : restChannel())),
    },
  ],
  shownTake: 0,
  clampsToLimits: false,
});
const BONE = {
  name: 'sword',
  joints: [joint(-1, { name: 'hilt', motion: { kind: 'quaternion' }, pose: [0, 0, 0, 1] })],
};
const SWORD = character({ id: 'c2', name: 'sword', skeleton: BONE, pose: filePose(BONE, 0), clampsToLimits: false });
const GRIP = { characterId: 'c2', leaderId: 'c1', joint: 1, span: [0.5, 1.5] as [number, number] };

export function scene(): Document {
  const store = new Store(documentOf(WALKER, SWORD));
  store.apply(addAttachment, GRIP);
  return store.document;
}

/** All files of a document, as saving writes them. */
export function savedOf(given: Document): Texts {
  // Numbers the parts.
  const store = new Store();
  store.adopt('Open', { document: given, selection: {} });
  const { document } = store;
  const jobs = changedFiles(document, new SavedParts().unsavedIn(document), ({ pose }) => pose);
  return new Map(jobs.map((job) => [job.name, savedFileOf({ ...job.write(job.name), name: job.name }).text]));
}
