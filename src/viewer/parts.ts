/** What an element consists of: its picture, what is shown before or instead, and its controls. */

/** Calls of the controls. */
export interface ControlEvents {
  toggle(): void;
  seek(timeSeconds: number): void;
}

/** The elements in the shadow root. All texts are set as text. */
export class Parts {
  /** Contains the canvas; has the focus. */
  readonly stage = document.createElement('div');
  readonly poster = document.createElement('img');
  private readonly frame = document.createElement('div');
  private readonly message = document.createElement('p');
  private readonly controls = document.createElement('div');
  private readonly play = document.createElement('button');
  private readonly time = document.createElement('input');
  private readonly seconds = document.createElement('span');

  constructor(root: ShadowRoot, events: ControlEvents) {
    const { frame, stage, poster, message, controls, play, time, seconds } = this;
    stage.className = 'stage';
    stage.tabIndex = 0;
    stage.setAttribute('role', 'img');
    stage.setAttribute('aria-keyshortcuts', 'Space ArrowLeft ArrowRight ArrowUp ArrowDown + - Home , .');
    poster.className = 'poster';
    poster.alt = '';
    message.className = 'message';
    message.setAttribute('role', 'alert');
    controls.className = 'controls';
    controls.setAttribute('role', 'group');
    controls.setAttribute('aria-label', 'Playback');
    play.type = 'button';
    play.addEventListener('click', () => events.toggle());
    time.type = 'range';
    time.step = 'any';
    time.setAttribute('aria-label', 'Time in seconds');
    time.addEventListener('input', () => events.seek(time.valueAsNumber));
    time.className = 'time';
    seconds.className = 'seconds';
    controls.append(play, time, seconds);
    this.setPoster('');
    this.setMessage('', true);
    this.setControls(false);
    this.setPlaying(false);
    frame.append(stage, poster, controls, message);
    root.append(frame);
  }

  setTheme(name: 'light' | 'dark'): void {
    this.frame.className = `frame ${name}`;
  }

  /** Adds a control after the others. */
  add(control: HTMLElement): void {
    this.controls.append(control);
  }

  setName(name: string): void {
    this.stage.setAttribute('aria-label', name);
  }

  /** An address; empty: none. */
  setPoster(address: string): void {
    this.poster.hidden = address === '';
    if (address === '') this.poster.removeAttribute('src');
    else this.poster.src = address;
  }

  /** Words for the reader; empty: none. @param isAlone nothing else is shown */
  setMessage(text: string, isAlone: boolean): void {
    const { message } = this;
    message.hidden = text === '';
    message.classList.toggle('alone', isAlone);
    message.textContent = text;
  }

  setControls(areShown: boolean): void {
    this.controls.hidden = !areShown;
  }

  setPlaying(isPlaying: boolean): void {
    this.play.className = isPlaying ? 'play playing' : 'play';
    this.play.setAttribute('aria-label', isPlaying ? 'Pause' : 'Play');
  }

  setTime(timeSeconds: number, [start, end]: readonly [number, number]): void {
    const { time, seconds } = this;
    if (this.controls.hidden) return;
    time.min = String(start);
    time.max = String(end);
    time.valueAsNumber = timeSeconds;
    const shown = `${(timeSeconds - start).toFixed(2)} / ${(end - start).toFixed(2)} s`;
    if (seconds.textContent !== shown) seconds.textContent = shown;
    time.setAttribute('aria-valuetext', `${timeSeconds.toFixed(2)} seconds`);
  }
}
