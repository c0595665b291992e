import { expect, it } from 'vitest';
import { optionsOf } from './attack/options.ts';

it('the options of attacks choose by name, and say the minutes and the seed', () => {
  const options = optionsOf(['--only', 'readers', '--only', 'killed', '--minutes', '0.5', '--seed', '169']);
  expect(options).toMatchObject({ minutes: 0.5, seed: 169, attacks: [{ name: 'killed' }, { name: 'readers' }] });
  const all = optionsOf([]);
  expect('attacks' in all && all.attacks.length).toBeGreaterThan(7);
});

it('the usage of attacks is printed where it is asked for, with what each shows', () => {
  const asked = optionsOf(['--help']);
  expect(asked).toEqual({ usage: expect.stringMatching(/^Usage: npm run attack/), isWrong: false });
  expect(asked).toMatchObject({ usage: expect.stringMatching(/^ {2}readers +mutated files of all kinds/m) });
});

it.each([
  [['--only', 'reader'], 'There is no attack "reader".'],
  [['--only', 'readers', '--only', 'x'], 'There is no attack "x".'],
  [['--minutes', 'ten'], '--minutes must be greater than 0, found ten.'],
  [['--seed', '1.5'], '--seed must be a whole number, found 1.5.'],
  [['--files', 'npz', '--files', 'exe'], '--files must be of skel axskel'],
  [['--replay', 'gone.json'], '--replay: gone.json could not be read: there is no such file or folder.'],
  [['--fast'], "Unknown option '--fast'"],
] as const)('wrong arguments of attacks are told in a sentence above the usage: %j', (args, sentence) => {
  const wrong = optionsOf(args);
  expect(wrong).toMatchObject({ isWrong: true, usage: expect.stringMatching(/\nUsage: npm run attack/) });
  expect('usage' in wrong && wrong.usage.startsWith(sentence)).toBe(true);
});
