/** Short texts about characters that are retargeted, or follow a joint of another one. */
import { type Character, type Document, shownTake } from '../../../model/document.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import { aligned } from '../../widgets/numbers/number-text.ts';

/** `follows rokoko-dance`, or the characters to which it is attached; empty if its own take alone moves it. */
export function followsText({ driver, leaders = [] }: Character): string {
  const names = driver ? [driver.source.take.name || driver.source.name] : leaders.map(({ name }) => name);
  return names.length ? `follows ${names.join(', ')}` : '';
}

/**
 * `Follows walker’s hand_r`, `Followed walker’s hand_r until 3.90 s`, or `Follows walker’s hand_r from 0.50 s`: by the
 * time; as `followsText` if it is not attached.
 */
export function followsAt(character: Character, timeSeconds: number): string {
  const { attached } = shownTake(character) ?? {};
  if (character.driver || !attached) {
    const text = followsText(character);
    return `${text.slice(0, 1).toUpperCase()}${text.slice(1)}`;
  }
  const time = timeSeconds + character.timeOffsetSeconds;
  const last = attached.list.findLast(({ span }) => span[0] <= time);
  const one = last ?? attached.list[0];
  const leader = character.leaders?.find(({ id }) => id === one.leaderId);
  const whose = `${leader?.name}’s ${jointName(leader?.skeleton, one.joint)}`;
  const at = (seconds: number) => `${aligned(seconds - character.timeOffsetSeconds, 2)} s`;
  if (!last) return `Follows ${whose} from ${at(one.span[0])}`;
  return time < one.span[1] ? `Follows ${whose}` : `Followed ${whose} until ${at(one.span[1])}`;
}

/** `moves walker`; empty if its take moves no other character. */
export function movesText({ characters }: Document, { id }: Character): string {
  const names = characters.filter(({ driver }) => driver?.sourceId === id).map(({ name }) => name);
  return names.length ? `drives ${names.join(', ')}` : '';
}
