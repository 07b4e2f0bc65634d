/** Waiting for something, but not for ever. */

/** What a promise comes to; an Error with the message if that takes longer than so many ms. */
export function within<T>(milliseconds: number, message: string, promise: Promise<T>): Promise<T> {
  let timer: ReturnType<typeof setTimeout> | undefined;
  const late = new Promise<never>((_, reject) => {
    timer = setTimeout(() => reject(new Error(message)), milliseconds);
  });
  return Promise.race([promise, late]).finally(() => clearTimeout(timer));
}
