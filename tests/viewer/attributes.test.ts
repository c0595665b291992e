/** What the attributes of `<marrow-viewer>` say, and what can't be. */
import { describe, expect, it } from 'vitest';
import { DEFAULT_DISPLAY } from '../../src/model/session.ts';
import { addressesIn, cameraOf, displayOf, numberOf, showingTake } from '../../src/viewer/attributes.ts';
import { openCharacters } from '../../src/viewer/open.ts';

const SKEL = 'balljoint root {\n  boxmin -1 -1 -1\n  boxmax 1 1 1\n}\n';
const ANIM = (end: number) =>
  `animation {\n  range 0 ${end}\n  numchannels 6\n${`  channel {\n    extrapolate constant constant\n    keys 1 {\n      0 0 flat flat\n    }\n  }\n`.repeat(6)}}\n`;

const given = (files: Readonly<Record<string, string>>) => ({
  files: Object.entries(files).map(([path, text]) => ({ path, blob: new Blob([text]) })),
});

describe('the attributes', () => {
  it('attributes are read as they are meant, with any blanks', () => {
    const wrong: string[] = [];
    const tell = (text: string) => wrong.push(text);
    expect(addressesIn(' a.skel\n  b%20c.skin ')).toEqual(['a.skel', 'b%20c.skin']);
    expect(addressesIn('')).toEqual([]);
    expect(numberOf('speed', '-0.5', tell)).toBe(-0.5);
    expect(numberOf('speed', null, tell)).toBeUndefined();
    expect(displayOf(null, tell)).toBe(DEFAULT_DISPLAY);
    expect(displayOf('bones, names no-grid', tell)).toMatchObject({
      skin: 'hidden',
      bones: true,
      names: true,
      grid: false,
    });
    expect(cameraOf('0,1,3, 0,1,0', tell)).toMatchObject({ distance: 3, target: [0, 1, 0] });
    expect(wrong).toEqual([]);
  });

  it('attributes that can’t be are told, with what was expected', () => {
    const wrong: string[] = [];
    const tell = (text: string) => wrong.push(text);
    numberOf('time', 'soon', tell);
    displayOf('feathers', tell);
    cameraOf('1,2,3', tell);
    expect(wrong.map((text) => text.replace(/ \(expected .*/s, ''))).toEqual([
      'time="soon"',
      'show="feathers"',
      'camera="1,2,3"',
    ]);
  });

  it('a take is shown by its name', async () => {
    const { characters, diagnostics, floor } = await openCharacters(
      given({ 'a.skel': SKEL, 'a_nod.anim': ANIM(1), 'a_wave.anim': ANIM(2) }),
    );
    expect(diagnostics.filter(({ severity }) => severity === 'error')).toEqual([]);
    expect(floor).toBe(-1);
    const wrong: string[] = [];
    const shown = (name: string | null) => {
      const [character] = showingTake(characters, name, (text) => wrong.push(text));
      return character.takes[character.shownTake].name;
    };
    expect([shown('a_wave'), shown('a_nod'), shown(null)]).toEqual(['a_wave', 'a_nod', 'a_nod']);
    expect(shown('dance')).toBe('a_nod');
    expect(wrong).toEqual(['take="dance" (expected a_nod, a_wave)']);
  });
});
