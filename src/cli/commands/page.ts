/** `marrow page`: characters as a web page in one file, the same as the page's *Save > Web page*. */
import { resolve } from 'node:path';
import { webPage } from '../../files/web-page/web-page.ts';
import { hasErrors } from '../../model/diagnostic.ts';
import { DISPLAY_WORDS, displayOfWords } from '../../model/display-words.ts';
import type { Character } from '../../model/document.ts';
import { loadAny, nothingRead, openLoaded } from '../load.ts';
import { ANY_FILE, anyInputs } from '../options/inputs.ts';
import { KEEP_OPTION } from '../options/keep.ts';
import { type Kind, number, numbers, oneOf, text } from '../options/kinds.ts';
import { flag, option } from '../options/option.ts';
import { shellCommand } from '../options/shell-command.ts';
import { report } from '../report.ts';
import { UsageError } from '../usage-error.ts';
import { writeOutput } from '../write-output.ts';

const CAMERA: Kind<readonly number[]> = {
  placeholder: 'X,Y,Z,TX,TY,TZ',
  what: '6 numbers: where the camera is, and what it looks at',
  read(given, misfit) {
    const all = numbers('').read(given, misfit);
    return all.length === 6 ? all : misfit();
  },
};

const SHOW: Kind<string> = {
  placeholder: 'WORD,WORD,…',
  what: `some of ${DISPLAY_WORDS.join(', ')}`,
  read: (given, misfit) => (displayOfWords(given) ? given.replaceAll(',', ' ') : misfit()),
};

export const page = shellCommand({
  name: 'page',
  summary: 'Writes a web page in one file that shows characters without a network.',
  inputs: anyInputs(['FILE… OUT.html'], { FILE: ANY_FILE, OUT: 'The page to write.' }),
  options: {
    take: option(text('NAME', 'a name'), 'Shows the take of that name.'),
    time: option(number('T'), 'Starts at this time in seconds.'),
    play: flag('Plays when it is opened.'),
    show: option(SHOW, 'Draws this of the characters, in the words of links.'),
    camera: option(CAMERA, 'Looks from the first point at the second, in metres; otherwise all is in the picture.'),
    theme: option(oneOf(['light', 'dark']), 'Sets the background.', { default: 'light' }),
    ...KEEP_OPTION,
  },
  examples: ['marrow page wasp.skel wasp.skin wasp_walk.anim wasp.html --play'],
  exits: {
    0: 'the page was written',
    1: 'a file has errors or is missing, or there is no character',
    2: 'wrong usage',
    3: 'the page could not be written',
  },
  async run({ inputs, options: { take, time, play, show, camera, theme, keep } }, io) {
    const [files, out] = [inputs.slice(0, -1), inputs.at(-1)];
    if (files.length === 0 || !out || !/\.html?$/i.test(out)) {
      throw new UsageError('page needs at least one file, and a page to write that ends in .html.');
    }
    const loaded = await loadAny(files, io.folder, { keep });
    const { document, diagnostics } = openLoaded(loaded);
    const problems = [...diagnostics, ...nothingRead(loaded, files)];
    report(problems, io);
    if (hasErrors(problems) || document.characters.length === 0) return 1;
    if (take !== undefined) checkTake(document.characters, take);
    const attributes = {
      controls: '',
      loop: '',
      ...(play && { autoplay: '' }),
      ...(take !== undefined && { take }),
      ...(time !== undefined && { time: `${time}` }),
      ...(show !== undefined && { show }),
      ...(camera && { camera: camera.join(',') }),
    };
    const made = webPage({ characters: document.characters, theme, attributes }, await import('virtual:web-page'));
    const written = writeOutput(resolve(io.folder, out), made);
    if ('failure' in written) {
      io.err(`marrow: ${out} could not be written: ${written.failure}.\n`);
      return 3;
    }
    await io.out(`${out}: web page, ${written.bytes} bytes\n`);
    return 0;
  },
});

function checkTake(characters: readonly Character[], take: string): void {
  const names = characters.flatMap(({ takes }) => takes.map(({ name }) => name));
  if (!names.includes(take)) {
    throw new UsageError(`--take takes one of ${names.join(', ') || 'no takes'}, found "${take}".`);
  }
}
