/**
 * Attachments of a take that is open, to characters that are: found by their names, so all others are opened before.
 * While one of them isn't, the plain file holds, and the attachments wait for it.
 */
import { sameValue } from '../../edit/delta.ts';
import { followLeaders, follows, leaderOf, withAttached } from '../../edit/follow/leaders.ts';
import { type Diagnostic, withoutPlace } from '../../model/diagnostic.ts';
import { type Character, EMPTY_DOCUMENT, findCharacter } from '../../model/document.ts';
import { folderOf, type ParsedFile, sameName, stemOf } from '../../model/files.ts';
import { jointReferred } from '../../model/skeleton/joint-reference.ts';
import { ownChannels } from '../../model/skeleton/skel-motion.ts';
import type { Attachment, Take } from '../../model/takes/take.ts';
import { withSource } from './assemble.ts';
import type { Opening } from './opening.ts';

type AttachFile = Extract<ParsedFile, { readonly kind: 'attach' }>;

/** Attaches the take at an index of a character, or says what it lacks. */
export function openAttached(opening: Opening, file: AttachFile, character: Character, take: number): void {
  const { characters, called } = opening;
  const shown = character.takes[take];
  const { waiting } = file;
  const whole = waiting ? waiting.whole : shown;
  if (waiting && !sameValue(shown, waiting.plain)) {
    opening.unused.push({ file, why: `${shown.name} was edited without what it follows.` });
    return;
  }
  const { list, problem } = attachmentsOf(file, character, characters.all, called(file.source));
  const withTake = (own: Take) => ({ ...character, takes: character.takes.with(take, own) });
  if (problem) {
    const plain = waiting?.plain ?? plainOf(file, character, whole);
    // Told once, with the file.
    if (opening.files.includes(file)) opening.diagnostics.push(problem);
    if (plain !== shown) characters.replace(withTake(plain));
    if (problem.severity === 'error') opening.used.add(file);
    else opening.unused.push({ file: { ...file, waiting: { whole, plain } }, why: problem.message });
    return;
  }
  const { base, flattened, others } = file.attach;
  const facts = {
    ...{ list, baseFile: base },
    ...(flattened?.others && { ofFlattened: flattened.others }),
    ...(others && { others }),
  };
  stayAtOrigin(opening, character, list);
  const leaders = characters.all.filter(({ id }) => list.some(({ leaderId }) => leaderId === id));
  const attached = withAttached(
    withTake({ ...whole, attached: facts }),
    list,
    leaders.map((leader) => leaderOf(leader, character)),
    take,
  );
  // Files have no places, so both are where they were together.
  const [{ scale }, ...more] = character.placements;
  const [first] = leaders;
  const placements = first && more.length === 0 ? [{ ...first.placements[0], scale }] : character.placements;
  characters.replace({ ...withSource(attached, file.source, character), placements });
  // Another one may follow this, and have been opened before.
  const document = { ...EMPTY_DOCUMENT, characters: characters.all };
  characters.replaceAll(followLeaders(EMPTY_DOCUMENT, document).characters);
  opening.opened.add(character.id);
  opening.used.add(file);
}

/** Both come to the place of their leader: where that was put beside a follower at the origin, it comes there before. */
function stayAtOrigin({ base, characters }: Opening, follower: Character, list: readonly Attachment[]): void {
  const [first] = list;
  const leader = characters.all.find(({ id }) => id === first?.leaderId);
  const { position } = follower.placements[0];
  if (!leader || findCharacter(base, leader.id) || position.some((part) => part !== 0)) return;
  const [own, ...others] = leader.placements;
  characters.replace({ ...leader, placements: [{ ...own, position }, ...others] });
}

/** The take of the plain file; without one that of the base. */
function plainOf({ plain }: AttachFile, { skeleton, pose }: Character, whole: Take): Take {
  if (!plain) return whole;
  const { markers } = whole;
  return { ...(skeleton ? ownChannels(plain, skeleton, pose) : plain), ...(markers && { markers }) };
}

function attachmentsOf(
  { attach: { attached }, source }: AttachFile,
  follower: Character,
  characters: readonly Character[],
  called: string,
): { readonly list: readonly Attachment[]; readonly problem?: Diagnostic } {
  const folder = folderOf(source);
  const list: Attachment[] = [];
  for (const [i, { character: name, joint: jointName, ...rest }] of attached.entries()) {
    const named = characters.filter((one) => one.id !== follower.id && one.skeleton && isCalled(one, name));
    const leader = named.find(({ sources }) => sources.some((own) => folderOf(own) === folder)) ?? named[0];
    const joint = leader?.skeleton && jointReferred(leader.skeleton.joints)(jointName);
    if (!leader || joint === undefined) {
      const what = leader
        ? `attached[${i}].joint: ${leader.name} has no joint "${jointName}".`
        : `attached[${i}].character: no open character is called "${name}".`;
      const assumed = 'the plain file holds until it is opened';
      return { list, problem: withoutPlace('warning', 'attach-leader-missing', what, called, assumed) };
    }
    if (follows({ ...EMPTY_DOCUMENT, characters }, leader, follower.id)) {
      const what = `attached[${i}].character: ${follower.name} can’t follow ${leader.name}, which follows ${follower.name} itself.`;
      return { list, problem: withoutPlace('error', 'attach-wrong', what, called) };
    }
    list.push({ ...rest, leaderId: leader.id, joint });
  }
  return { list };
}

/** By its own name, that of its skeleton, or of the file of that. */
function isCalled({ name, skeleton, parts }: Character, wanted: string): boolean {
  const file = parts?.skeleton?.file;
  return [name, skeleton?.name ?? '', file ? stemOf(file.source) : ''].some((one) => sameName(one, wanted));
}
