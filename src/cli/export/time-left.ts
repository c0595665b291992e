/** Estimates the time left from how long what is done took. */

/** Before this much is done, the estimate says nothing. */
const MIN_SECONDS = 2;

/** @returns a function that says how long the rest takes, "2 min 10 s"; empty if that is not known yet */
export function timeLeft(now = () => performance.now()): (done: number, of: number) => string {
  const begun = now();
  return (done, of) => {
    const seconds = (now() - begun) / 1000;
    return seconds < MIN_SECONDS || done === 0 ? '' : durationText((seconds / done) * (of - done));
  };
}

/** To the second below an hour, then to the minute. */
function durationText(seconds: number): string {
  const whole = Math.ceil(seconds);
  const minutes = Math.floor(whole / 60);
  if (minutes >= 60) return `${Math.floor(minutes / 60)} h ${minutes % 60} min`;
  return minutes > 0 ? `${minutes} min ${whole % 60} s` : `${whole} s`;
}
