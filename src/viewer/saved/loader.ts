/** Starts a saved page: unpacks its viewer and runs that, the one script besides this that the page's policy allows. */
import { unpack } from './unpack.ts';

function tell(words: string): void {
  const line = document.createElement('p');
  line.setAttribute('role', 'alert');
  line.textContent = words;
  document.body.prepend(line);
}

async function start(): Promise<void> {
  const bytes = await unpack(document.querySelector('pre[data-viewer]')?.textContent ?? '');
  const script = document.createElement('script');
  script.type = 'module';
  script.textContent = new TextDecoder().decode(bytes);
  document.head.append(script);
}

if ('DecompressionStream' in window) start().catch(() => tell('This page is damaged. Save it again.'));
else tell('This browser is too old for this page, which takes Chrome 103, Firefox 113, Safari 16.4, or a later one.');
