/** The dialog for attaching a character to a joint of another one: the selected joint, or one of the list. */
import type { ArgsOf, Command } from '../../../edit/command.ts';
import { addAttachment, putDown } from '../../../edit/commands/beside/attach.ts';
import { type Character, type Document, findCharacter, rangeOfTakes, shownTake } from '../../../model/document.ts';
import type { Selection } from '../../../model/session.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import { UserError } from '../../../model/user-error.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import type { Uses } from '../../state/workbench.ts';
import type { DialogContent } from '../../widgets/dialog.ts';
import { element } from '../../widgets/dom.ts';
import { askChoice, askNumber } from '../../widgets/form/form.ts';
import { shown } from '../../widgets/numbers/number-text.ts';
import { toolDialog } from '../timeline/tool-dialog.ts';

const TITLE = 'Attach to…';
/** Seconds beyond the last take, so that its last frame is within. */
const BEYOND = 1;

/** What is to follow what, and when, in seconds of the timeline. */
export interface Asked {
  readonly follower: string;
  /** Of `choiceOf`. */
  readonly joint: string;
  readonly from: number;
  readonly until: number;
}

type Attached = ArgsOf<typeof addAttachment> & {
  /** In seconds of the timeline; undefined: it is held to the end of the takes. */
  readonly putDownAt: number | undefined;
};

/** Attaches, and puts down within the takes, so that nothing jumps there either. */
export const attachUntil: Command<Attached> = {
  id: addAttachment.id,
  label: addAttachment.label,
  run(document, { putDownAt, ...args }) {
    const attached = addAttachment.run(document, args);
    const { characterId, span } = args;
    const character = findCharacter(attached, characterId);
    const isTakenOn = character && shownTake(character)?.attached?.list.some((one) => one.span[0] === span[1]);
    if (putDownAt === undefined || isTakenOn) return attached;
    return putDown.run(attached, { characterId, timeSeconds: putDownAt });
  },
};

export function attachDialog(
  wb: Uses<'store' | 'transport' | 'timeline' | 'messages' | 'dialog'>,
  close: () => void,
): DialogContent {
  const { document, selection } = wb.store;
  const followers = document.characters.filter(({ skeleton }) => skeleton);
  const { follower, leader } = meantBy(document, selection, currentCharacter(wb));
  if (!follower || !leader) {
    return { title: TITLE, body: element('p', {}, 'Open two characters with skeletons first.'), kind: 'tool-dialog' };
  }
  const from = Number(wb.transport.get().timeSeconds.toFixed(3));
  const until = Math.max(from, endOf(document));
  return toolDialog(wb, close, {
    title: TITLE,
    // The result is visible in the viewport.
    kind: 'is-aside',
    about:
      'Its root follows the joint from where it is then, until it is put down. To pick a joint, select it before you open this.',
    asked: [
      askChoice('follower', 'Character', named(followers), { value: follower.id }),
      askChoice('joint', 'To', jointsOf(followers), { value: choiceOf(leader.id, leader.joint), autofocus: true }),
      askNumber('from', 'From', from, { unit: 's' }),
      askNumber('until', 'Until', until, { unit: 's' }),
    ],
    command: attachUntil,
    args: (answers) => {
      const [follower, joint] = [answers.choice('follower'), answers.choice('joint')];
      return argsOf(document, { follower, joint, from: answers.number('from'), until: answers.number('until') });
    },
    result: ({ characterId, leaderId, joint, putDownAt }, _after, answers) => {
      const to = findCharacter(document, leaderId);
      const name = findCharacter(document, characterId)?.name;
      const end = putDownAt === undefined ? 'to the end' : `until ${shown(putDownAt)} s, and stays where it is then`;
      return `${name} follows ${jointName(to?.skeleton, joint)} of ${to?.name} from ${shown(answers.number('from'))} s ${end}.`;
    },
  });
}

/** The arguments of `attachUntil`. */
export function argsOf(document: Document, { follower: id, joint: choice, from, until }: Asked): Attached {
  const [leaderId, joint] = choice.split(SEPARATOR);
  const follower = findCharacter(document, id);
  if (!follower) throw new UserError('The character is no longer there.');
  const end = endOf(document);
  const putDownAt = until < end ? until : undefined;
  // Spans are in seconds of the take.
  const at = (seconds: number) => seconds + follower.timeOffsetSeconds;
  const span: [number, number] = [at(from), at(putDownAt ?? Math.max(from, end) + BEYOND)];
  if (!(span[0] < span[1])) throw new UserError('It must begin before it ends.');
  return { characterId: follower.id, leaderId, joint: Number(joint), span, putDownAt };
}

/** When the takes end, as it is offered. */
function endOf(document: Document): number {
  return Number((rangeOfTakes(document)?.[1] ?? 0).toFixed(3));
}

/** Between the parts of a choice's value; no id has it. */
const SEPARATOR = ' ';

export function choiceOf(id: string, joint: number): string {
  return `${id}${SEPARATOR}${joint}`;
}

function named(characters: readonly Character[]) {
  return characters.map(({ id, name }) => [id, name] as const);
}

function jointsOf(characters: readonly Character[]) {
  return characters.flatMap(({ id, name, skeleton }) =>
    (skeleton?.joints ?? []).map((_, j) => [choiceOf(id, j), `${name}: ${jointName(skeleton, j)}`] as const),
  );
}

interface Meant {
  readonly follower: Character | undefined;
  readonly leader: { readonly id: string; readonly joint: number } | undefined;
}

/**
 * A selected joint below a root is the one to be followed, by the next character that is not that one; otherwise the
 * current character follows the first other one.
 */
export function meantBy({ characters }: Document, { characterId, joint = 0 }: Selection, current?: Character): Meant {
  const able = characters.filter(({ skeleton }) => skeleton);
  const other = (id: string | undefined) => able.find((one) => one.id !== id);
  if (joint > 0 && characterId !== undefined)
    return { follower: other(characterId), leader: { id: characterId, joint } };
  const follower = current?.skeleton ? current : able[0];
  const leader = other(follower?.id);
  return { follower, leader: leader && { id: leader.id, joint: 0 } };
}
