/** A character as files, edits of it, and what the page says. */

import { saveCharacter } from '../../src/files/save/saving.ts';
import type { Character } from '../../src/model/document.ts';
import { character, skeleton, skin, takeOfValues } from '../helpers/builders.ts';
import type { pageWith } from './disk.ts';

export const SKEL = saveCharacter(character(), 'skel')[0].text;
export const ANIM = saveCharacter(character({ takes: [takeOfValues('hero_walk', new Array(9).fill(0.5))] }), 'anim')[0]
  .text;
export const SKIN = saveCharacter(character({ skins: [skin()] }), 'skin')[0].text;
/** A character with a take, by the names of its files. */
export const HERO = { 'hero.skel': SKEL, 'hero_walk.anim': ANIM };

/** Edits of its take, its pose and its limits. */
export const longer = (c: Character): Character => ({ ...c, takes: c.takes.map((own) => ({ ...own, range: [0, 7] })) });
export const posed = (c: Character): Character => ({
  ...c,
  shownTake: -1,
  pose: c.pose.map((v, i) => (i === 4 ? 0.25 : v)),
});
export const limited = (c: Character): Character => {
  const own = c.skeleton ?? skeleton();
  const joints = own.joints.map((j) => ({ ...j, limits: [{ min: -2, max: 3 }, ...j.limits.slice(1)] }));
  return { ...c, skeleton: { ...own, joints } };
};
/** The message that passes. */
export const said = (page: Awaited<ReturnType<typeof pageWith>>) => page.messages.passing.get();
