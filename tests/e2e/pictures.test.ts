/** Pictures and videos: what was written is decoded again and compared with the viewport at that time. */
import { unzipSync } from 'fflate';
import { ALL_FORMATS, BufferSource, EncodedPacketSink, Input } from 'mediabunny';
import type { Page } from 'playwright-core';
import { expect, it } from 'vitest';
import type { PictureOptions, VideoOptions } from '../../src/ui/state/pictures.ts';
import { dropFiles, readPixels, withPage } from '../helpers/page.ts';
import { shown } from './checks/saving.ts';

const SKEL = 'balljoint mast { boxmin -0.2 0 -0.2 boxmax 0.2 1 0.2 }';
/** Leans over to a right angle within half a second. */
const ANIM = `animation { range 0 0.5 numchannels 6
${[0, 0, 0, 0, 0, 1.5]
  .map((end) => `channel { extrapolate constant constant keys 2 { 0 0 linear linear 0.5 ${end} linear linear } }`)
  .join('\n')} }`;
const SMALL = { width: 160, height: 120, framesPerSecond: 10 } as const;
const TIMES = [0, 0.1, 0.2, 0.3, 0.4];

const bytesOf = async (base64: Promise<string>) => new Uint8Array(Buffer.from(await base64, 'base64'));

function picture(page: Page, options: PictureOptions = {}): Promise<Uint8Array> {
  return bytesOf(
    page.evaluate(async (wanted) => {
      const blob = await window.marrow.picture(wanted);
      return window.btoa(
        Array.from(new Uint8Array((await blob?.arrayBuffer()) ?? []), (c) => String.fromCharCode(c)).join(''),
      );
    }, options),
  );
}

function video(page: Page, options: VideoOptions): Promise<Uint8Array> {
  return bytesOf(
    page.evaluate(async (wanted) => {
      const blob = await window.marrow.video(wanted);
      return window.btoa(
        Array.from(new Uint8Array((await blob?.arrayBuffer()) ?? []), (c) => String.fromCharCode(c)).join(''),
      );
    }, options),
  );
}

/** RGBA of an image file, rows from the top. */
async function decoded(page: Page, bytes: Uint8Array) {
  const { width, height, base64 } = await page.evaluate(async (given) => {
    const bytes = Uint8Array.from(atob(given), (letter) => letter.charCodeAt(0));
    const bitmap = await createImageBitmap(new Blob([bytes]), { premultiplyAlpha: 'none' });
    const pen = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
    if (!pen) throw new Error('no 2D canvas');
    pen.drawImage(bitmap, 0, 0);
    const { data, width, height } = pen.getImageData(0, 0, bitmap.width, bitmap.height);
    return { width, height, base64: btoa(Array.from(data, (c) => String.fromCharCode(c)).join('')) };
  }, Buffer.from(bytes).toString('base64'));
  return { width, height, data: Uint8Array.from(Buffer.from(base64, 'base64')) };
}

/** RGBA of each frame of a video, decoded by the browser, with its time in seconds. */
async function decodedFrames(page: Page, bytes: Uint8Array) {
  const input = new Input({ formats: ALL_FORMATS, source: new BufferSource(bytes) });
  const track = await input.getPrimaryVideoTrack();
  const config = await track?.getDecoderConfig();
  if (!track || !config) throw new Error('no video');
  const packets: { base64: string; type: 'key' | 'delta'; timestamp: number }[] = [];
  for await (const { data, type, timestamp } of new EncodedPacketSink(track).packets()) {
    packets.push({ base64: Buffer.from(data).toString('base64'), type, timestamp: Math.round(1e6 * timestamp) });
  }
  const description = config.description && Buffer.from(config.description as Uint8Array).toString('base64');
  const frames = await page.evaluate(
    async ({ packets, codec, description }) => {
      const raw = (base64: string) => Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
      const found: { seconds: number; base64: string }[] = [];
      const decoder = new VideoDecoder({
        output(frame) {
          const pen = new OffscreenCanvas(frame.displayWidth, frame.displayHeight).getContext('2d');
          pen?.drawImage(frame, 0, 0);
          const data = pen?.getImageData(0, 0, frame.displayWidth, frame.displayHeight).data ?? [];
          const base64 = btoa(Array.from(data, (c) => String.fromCharCode(c)).join(''));
          found.push({ seconds: frame.timestamp / 1e6, base64 });
          frame.close();
        },
        error: (error) => reportError(error),
      });
      decoder.configure({ codec, ...(description && { description: raw(description) }) });
      for (const { base64, type, timestamp } of packets) {
        decoder.decode(new EncodedVideoChunk({ type, timestamp, data: raw(base64) }));
      }
      await decoder.flush();
      return found;
    },
    { packets, codec: config.codec, description },
  );
  return frames.map(({ seconds, base64 }) => ({ seconds, data: Uint8Array.from(Buffer.from(base64, 'base64')) }));
}

/** Mean difference of red, green and blue, of 255. */
function difference(a: ArrayLike<number>, b: ArrayLike<number>): number {
  expect(a.length).toBe(b.length);
  let sum = 0;
  for (let i = 0; i < a.length; i++) if (i % 4 < 3) sum += Math.abs(a[i] - b[i]);
  return sum / (0.75 * a.length);
}

const alphas = (data: Uint8Array) => data.filter((_, i) => i % 4 === 3);
const canvasSize = (page: Page) =>
  page.evaluate(() => {
    const canvas = document.querySelector('canvas');
    return canvas && [canvas.width, canvas.height, canvas.clientWidth, canvas.clientHeight];
  });
const state = async (page: Page) => [
  await canvasSize(page),
  await page.evaluate(() => [window.marrow.worldMatrices(), window.marrow.pointOnPage([0, 1, 0])]),
];

it('pictures and videos are what the viewport shows at their times, and leave the page as it was', () =>
  withPage(
    async ({ page, download }) => {
      await dropFiles(page, [
        { name: 'mast.skel', bytes: SKEL },
        { name: 'mast_lean.anim', bytes: ANIM },
      ]);
      await shown(page, 'mast');
      await page.evaluate(() => window.marrow.seek(0.25));
      const before = await state(page);

      // The size on screen is the default.
      const place = await page.locator('canvas').first().boundingBox();
      if (!place) throw new Error('no canvas');
      const whole = await decoded(page, await picture(page, { hasTools: true }));
      expect([whole.width, whole.height]).toEqual([place.width, place.height]);
      // Away from the tools of the page over it.
      const [x, y, side] = [place.width / 2 - 40, place.height / 2 - 20, 80];
      const onScreen = await readPixels(page, { x: place.x + x, y: place.y + y, width: side, height: side });
      const cut = Array.from({ length: side }, (_, row) => {
        const from = 4 * ((y + row) * whole.width + x);
        return [...whole.data.subarray(from, from + 4 * side)];
      }).flat();
      expect(difference(cut, onScreen.data)).toBeLessThan(0.5);
      expect(new Set(alphas(whole.data))).toEqual(new Set([255]));

      const clear = await decoded(page, await picture(page, { ...SMALL, hasBackground: false, hasGrid: false }));
      expect([clear.width, clear.height]).toEqual([SMALL.width, SMALL.height]);
      const covered = alphas(clear.data).filter((alpha) => alpha > 0).length;
      expect(covered).toBeGreaterThan(100);
      expect(covered).toBeLessThan(0.5 * SMALL.width * SMALL.height);

      const pngs = unzipSync(await video(page, { ...SMALL, format: 'png', name: 'lean' }));
      expect(Object.keys(pngs)).toEqual([0, 1, 2, 3, 4].map((n) => `lean/lean_000${n}.png`));
      const stills: Uint8Array[] = [];
      for (const png of Object.values(pngs)) stills.push((await decoded(page, png)).data);
      await page.evaluate(() => window.marrow.seek(0.3));
      const drawn = await decoded(page, await picture(page, SMALL));
      expect(difference(drawn.data, stills[3])).toBe(0);
      await page.evaluate(() => window.marrow.seek(0.25));
      /** Of the picture that is most like it. */
      const nearest = (data: Uint8Array) => {
        const all = stills.map((still) => difference(still, data));
        return all.indexOf(Math.min(...all));
      };

      const hasH264 = await page.evaluate(async () => {
        const config = { codec: 'avc1.42001e', width: 160, height: 120 };
        return (await VideoEncoder.isConfigSupported(config)).supported ?? false;
      });
      for (const format of hasH264 ? (['mp4', 'webm'] as const) : (['webm'] as const)) {
        const frames = await decodedFrames(page, await video(page, { ...SMALL, format }));
        expect(frames.map(({ seconds }) => Math.round(10 * seconds) / 10)).toEqual(TIMES);
        expect(frames.map(({ data }) => nearest(data))).toEqual([0, 1, 2, 3, 4]);
        for (const [i, { data }] of frames.entries()) expect(difference(data, stills[i])).toBeLessThan(6);
      }
      if (!hasH264) {
        console.info('This Chromium has no H.264: no MP4 was decoded.');
        await expect(video(page, { ...SMALL, format: 'mp4' })).rejects.toThrow('can’t write mp4 at 160 × 120');
      }

      const gif = Buffer.from(await video(page, { ...SMALL, format: 'gif' })).toString('base64');
      const inGif = await page.evaluate(async (base64) => {
        const data = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
        const decoder = new ImageDecoder({ data, type: 'image/gif' });
        await Promise.all([decoder.completed, decoder.tracks.ready]);
        const count = decoder.tracks.selectedTrack?.frameCount;
        const { image } = await decoder.decode({ frameIndex: 3 });
        const pen = new OffscreenCanvas(image.displayWidth, image.displayHeight).getContext('2d');
        pen?.drawImage(image, 0, 0);
        const pixels = pen?.getImageData(0, 0, image.displayWidth, image.displayHeight).data ?? [];
        return { count, duration: image.duration, pixels: Array.from(pixels) };
      }, gif);
      expect([inGif.count, inGif.duration]).toEqual([5, 100_000]);
      expect(nearest(Uint8Array.from(inGif.pixels))).toBe(3);

      await expect.poll(() => state(page)).toEqual(before);
      await expect(page.evaluate(() => window.marrow.picture({ width: 1e6, height: 10 }))).rejects.toThrow(
        /can't draw 1000000 × 10 pixels|convert|canvas/i,
      );
      await expect.poll(() => state(page)).toEqual(before);

      // The dialogs: a video saved, one cancelled, a picture.
      const dialog = page.getByRole('dialog', { name: 'Video' });
      await page.evaluate(() => void window.marrow.run('save.video'));
      await dialog.getByLabel('Format').selectOption('webm');
      await expect
        .poll(() => dialog.getByLabel('Format').locator('option').allTextContents())
        .toEqual([...(hasH264 ? ['MP4 (H.264)'] : []), 'WebM (VP9)', 'GIF', 'PNG sequence (.zip)']);
      await dialog.getByLabel('Frame rate').fill('8');
      await expect.poll(() => dialog.textContent()).toContain('4 frames, 0.5 s.');
      const saved = await download(() => dialog.getByRole('button', { name: 'Save' }).click());
      expect(saved.name).toBe('mast_lean.webm');
      await expect.poll(() => dialog.count()).toBe(0);
      await expect.poll(() => page.locator('body').textContent()).toContain('mast_lean.webm was saved');

      await page.evaluate(() => void window.marrow.run('save.video'));
      await dialog.getByLabel('Frame rate').fill('0');
      await expect.poll(() => dialog.textContent()).toContain('must be a number from 1 to 1000');
      await dialog.getByLabel('Frame rate').fill('1000');
      await dialog.getByRole('button', { name: 'Save' }).click();
      await expect.poll(() => dialog.textContent()).toContain('of 500');
      await page.keyboard.press('Escape');
      await expect.poll(() => state(page)).toEqual(before);

      await page.evaluate(() => void window.marrow.run('save.picture'));
      const asked = page.getByRole('dialog', { name: 'Picture' });
      const still = await download(() => asked.getByRole('button', { name: 'Save' }).click());
      expect(still.name).toBe('mast.png');
      expect(still.text).toContain('PNG');
      await expect.poll(() => state(page)).toEqual(before);
    },
    { size: { width: 1024, height: 640 }, drawn: true },
  ));

it('a picture taken as soon as the time is another shows where the followed walker is then, and leaves it in view', () =>
  withPage(
    async ({ page }) => {
      await page.waitForFunction(() => window.marrow?.characters()[0]?.dofs.length === 93);
      const pair = await page.evaluate(async () => {
        const size = { width: 120, height: 90, hasGrid: false };
        const text = async () =>
          JSON.stringify([...new Uint8Array((await window.marrow.picture(size).then((b) => b?.arrayBuffer())) ?? [])]);
        window.marrow.seek(3.2);
        const atOnce = await text();
        for (let f = 0; f < 3; f++) await new Promise((resolve) => requestAnimationFrame(resolve));
        return [atOnce, await text()];
      });
      expect(pair[0]).toBe(pair[1]);
      expect(pair[0].length).toBeGreaterThan(1000);
    },
    { walking: true, drawn: true, size: { width: 480, height: 360 } },
  ));
