// Long work in slices, so that the page stays alive: runs a generator for a few milliseconds at a time.
export const slice_ms = 7;

const breathe = (): Promise<void> => new Promise((resolve) => {
  const channel = new MessageChannel();
  channel.port1.onmessage = () => { channel.port1.close(); resolve(); };
  channel.port2.postMessage(0);
});

/** The generator's result; null where `stopped()` said so on the way. */
export async function in_slices<T>(work: Generator<void, T>, stopped: () => boolean): Promise<T | null> {
  for (;;) {
    const end = performance.now() + slice_ms;
    while (performance.now() < end) {
      const step = work.next();
      if (step.done) return step.value;
    }
    await breathe();
    if (stopped()) return null;
  }
}
