/**
 * Keying what was captured. Sampled curves have a value at every frame and take no single keys, so those of the joints
 * become keys first, which changes them by up to a tolerance; or a layer over them is keyed; or the frames are offset
 * for a moment. All are offered, not done; offer taken, it is one step.
 */

import { documentIn, type Edit } from '../../../edit/change.ts';
import type { ArgsOf } from '../../../edit/command.ts';
import { keyPose } from '../../../edit/commands/keying.ts';
import { convertSteps } from '../../../edit/commands/samples.ts';
import { cutName, SHORT_NAME } from '../../../edit/cut-name.ts';
import { EditPreview } from '../../../edit/edit-preview.ts';
import type { KeyOptions } from '../../../edit/key-dofs.ts';
import { type Converted, usualTolerance } from '../../../edit/samples/convert.ts';
import { unkeyedAt } from '../../../edit/unkeyed.ts';
import type { Steps } from '../../../evaluate/steps.ts';
import { type Character, type Document, findCharacter, shownTake } from '../../../model/document.ts';
import { sentenceOf } from '../../../model/failure.ts';
import { characterDofs } from '../../../model/skeleton/dofs.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import { askForMoment } from '../../state/add-keys.ts';
import { shownPerUnit, unitText } from '../../state/joints/angles.ts';
import { lengthUnit } from '../../state/joints/length-unit.ts';
import { onDemand } from '../../state/on-demand.ts';
import type { Uses } from '../../state/workbench.ts';
import { inSlices } from '../../widgets/in-slices.ts';
import { errorSize, plural, shown } from '../../widgets/numbers/number-text.ts';
import { channelsOfJoint } from '../timeline/channels.ts';

type Parts = Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages'>;

/** Sampled DOFs of a character. */
interface Sampled {
  readonly character: Character;
  readonly dofs: readonly number[];
}

interface Wanted {
  readonly character: Character;
  /** To become keys: those sampled of the same joints, whose angles are converted together. */
  readonly channels: readonly number[];
}

/**
 * Says that some of these DOFs are sampled, with a button that converts their joints' curves to keys and keys the DOFs
 * as displayed at the current time.
 * @param others that are to be keyed, too, and are sampled
 */
export function offerToConvert(wb: Parts, of: Sampled, options: KeyOptions, others: readonly Sampled[] = []): void {
  const { dofs } = of;
  const { id: characterId } = of.character;
  const { timeSeconds } = wb.transport.get();
  const wanted = wantedOf(wb.store.document, characterId, dofs);
  if (!wanted) return;
  const { character, channels } = wanted;
  const what = channels.length === 1 ? 'The curve' : `The ${channels.length} curves`;
  const have = channels.length === 1 ? 'is sampled: it has a value' : 'are sampled: they have a value';
  const { document } = wb.store;
  const posed = [...unkeyedAt(character, timeSeconds)].flatMap(([index, value]) =>
    dofs.includes(index) ? [{ index, value }] : [],
  );
  const pose = { characterId, dofs: posed };
  const names = others.map((one) => cutName(one.character.name, SHORT_NAME)).join(', ');
  const ofAll = names && ` of ${cutName(character.name, SHORT_NAME)}`;
  const too = names && ` So are those of ${names}: select ${others.length > 1 ? 'each' : 'it'} alone to key them.`;
  wb.messages.confirm(
    `${what} of ${jointsOf(character, channels)}${ofAll} ${have} at every frame, and no single keys.${too}`,
    [
      {
        label: 'Convert to keys and key',
        run: () => convertAndKey(wb, { characterId, dofs, timeSeconds, ...options }),
      },
      {
        label: 'Key in a layer',
        run: () => void keyInLayer(wb, { characterId, dofs: [...dofs], timeSeconds, ...options }),
      },
      ...(posed.length > 0 ? [{ label: 'Key for a moment…', run: () => askForMoment(wb, pose, document, false) }] : []),
    ],
    () => wb.store.document !== document,
  );
}

/** The frames stay as they are, below a new layer. */
async function keyInLayer(wb: Parts, args: ArgsOf<typeof keyPose>): Promise<void> {
  const edits = await onDemand(wb.messages, 'Layers', () => import('../layers/edits.ts'));
  edits?.addAndKey(wb, args);
}

function wantedOf(document: Document, characterId: string, dofs: readonly number[]): Wanted | undefined {
  const character = findCharacter(document, characterId);
  const take = character && shownTake(character);
  if (!character || !take) return undefined;
  const all = characterDofs(character.skeleton, character.morphs);
  const joints = new Set(dofs.map((dof) => all[dof]?.joint ?? -1));
  const given = new Set(dofs);
  const ranges = [...joints].map((joint) => channelsOfJoint(character, joint));
  const isMeant = (dof: number) => given.has(dof) || ranges.some(([first, end]) => dof >= first && dof < end);
  const channels = [...take.channels.keys()].filter((dof) => take.channels[dof].kind === 'samples' && isMeant(dof));
  return channels.length > 0 ? { character, channels } : undefined;
}

/** `chest`, `2 joints`, `walker`. */
function jointsOf(character: Character, channels: readonly number[]): string {
  const all = characterDofs(character.skeleton, character.morphs);
  const joints = [...new Set(channels.map((channel) => all[channel]?.joint ?? -1))];
  const [joint] = joints;
  if (joints.length > 1) return plural(joints.length, 'joint');
  return character.skeleton && joint >= 0 ? jointName(character.skeleton, joint) : character.name;
}

/** In slices, since long takes have many frames; if anything else changes meanwhile, nothing is done. */
function convertAndKey(wb: Parts, args: ArgsOf<typeof keyPose> & { readonly dofs: readonly number[] }): void {
  const { store, messages, transport } = wb;
  const { characterId, dofs, timeSeconds } = args;
  // What is keyed is what was displayed then.
  if (transport.get().timeSeconds !== timeSeconds) transport.update((p) => ({ ...p, timeSeconds, playing: false }));
  const wanted = wantedOf(store.document, characterId, dofs);
  if (!wanted) return;
  const label = `Convert to keys and key ${jointsOf(wanted.character, wanted.channels)}`;
  const preview = new EditPreview(store, label, () => {
    messages.note(`${label} was stopped because the document has changed. Try again.`, 'warning');
  });
  inSlices(converting(preview.base, wanted, args), {
    isOver: () => preview.over,
    progress: (part) => messages.note(`Converting to keys: ${Math.round(100 * part)} %`),
    done({ edit, report }) {
      preview.show(edit);
      preview.keep();
      messages.note(`${convertedText(wb, wanted.character, report)}, and keyed at ${shown(timeSeconds)} s.`);
    },
    failed(error) {
      preview.putBack();
      messages.note(`${label}: ${sentenceOf(error)}`, 'warning');
    },
  });
}

function* converting(
  document: Document,
  { character, channels }: Wanted,
  args: ArgsOf<typeof keyPose>,
): Steps<{ readonly edit: Edit; readonly report: Converted }> {
  const tolerance = usualTolerance(character.skeleton);
  const { edit, report } = yield* convertSteps(document, { characterId: character.id, channels, tolerance });
  return { edit: keyPose.run(documentIn(edit), args), report };
}

/** `Converted 3 curves to 212 keys, at most 0.4 cm and 0.9° off`. */
function convertedText(wb: Uses<'settings'>, character: Character, report: Converted): string {
  const { angles } = wb.settings.get();
  const { channels, keysAfter, worstPosition, worstAngle } = report;
  const turned = `${errorSize(worstAngle.error * shownPerUnit('angle', angles))}${unitText('angle', angles)}`;
  const off = `${errorSize(worstPosition.error)} ${lengthUnit(character)}`.trim();
  const what = `${plural(channels.length, 'curve')} to ${plural(keysAfter, 'key')}`;
  return `Converted ${what}, at most ${off} and ${turned} off`;
}
