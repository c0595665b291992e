/**
 * Tells how characters that were just opened were taken where their file states no unit and no up axis, or a unit that
 * can hardly be, and offers each other way as a button.
 */

import { setSpace } from '../edit/commands/spaces.ts';
import type { Store } from '../edit/store.ts';
import { metresPerUnit } from '../evaluate/space/metres.ts';
import { spaceText, unitText, upText } from '../evaluate/space/space.ts';
import { type SpaceChoices, spaceChoices } from '../evaluate/space/space-choices.ts';
import { type Character, findCharacter, shownTake } from '../model/document.ts';
import { skeletonKey } from '../model/skeleton/skeleton-key.ts';
import type { Space } from '../model/space.ts';
import { attempt } from '../ui/state/actions/attempt.ts';
import type { Messages, Offer } from '../ui/state/messages.ts';
import { shown } from '../ui/widgets/numbers/number-text.ts';
import type { ViewCamera } from '../view/camera/view-camera.ts';

interface Parts {
  readonly store: Store;
  readonly messages: Messages;
  readonly camera: Pick<ViewCamera, 'reveal'>;
}

/** Skeletons told of; what is wrong with thousands is seen in a few. */
const MAX_TOLD = 3;

/** @param opened new characters; those of one skeleton have one space, and are told of once */
export function offerSpaces(parts: Parts, opened: readonly Character[]): void {
  const seen = new Set<string>();
  for (const character of opened) {
    const { skeleton, space } = character;
    const key = skeleton && skeletonKey(skeleton);
    if (!skeleton || !space || key === undefined || seen.has(key)) continue;
    seen.add(key);
    const choices = spaceChoices(skeleton, shownTake(character), space);
    if (!choices) continue;
    const tall = `${rough(choices.height)} m tall`;
    const text =
      space.known === 'stated'
        ? `${character.name} is ${tall}: its file states ${unitText(space)}.`
        : `${character.name} is guessed to be in ${spaceText(space)}: ${tall}.`;
    parts.messages.suggest(
      text,
      choices.others.map((other) => offerOf(parts, character, other, choices, text)),
      () => findCharacter(parts.store.document, character.id)?.space !== space,
    );
    if (seen.size >= MAX_TOLD) return;
  }
}

function offerOf(
  { store, messages, camera }: Parts,
  character: Character,
  space: Space,
  { height }: SpaceChoices,
  text: string,
): Offer {
  const { id, name, space: now } = character;
  return {
    label: labelOf(space, now, now ? (height / metresPerUnit(now)) * metresPerUnit(space) : height),
    run: () => {
      if (!findCharacter(store.document, id)) {
        messages.note(`${name} is not open any more.`, 'warning');
        return;
      }
      attempt(messages, () => store.apply(setSpace, { characterId: id, space, ofSkeleton: true }));
      messages.withdraw(text);
      camera.reveal(id);
    },
  };
}

/** What differs: `Z up`, `Inches`, `1.7 m tall`. @param height that the character would have, metres */
function labelOf(space: Space, now: Space | undefined, height: number): string {
  if (space.up !== now?.up) return upText(space).replace(/^./, (axis) => axis.toUpperCase());
  if (space.unit === 'own') return `${shown(Number(height.toPrecision(2)))} m tall`;
  const [first, ...rest] = unitText(space);
  return `${first.toUpperCase()}${rest.join('')}`;
}

const rough = (metres: number) => shown(Number(metres.toPrecision(3)));
