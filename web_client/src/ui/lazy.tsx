import { useSignal } from "@preact/signals";
import type { FunctionComponent } from "preact";
import { useEffect } from "preact/hooks";

/** A component that is fetched when it is first shown; until then its place is empty. */
export function lazy<P extends object>(
  load: () => Promise<FunctionComponent<P>>,
): FunctionComponent<P> {
  let loaded: FunctionComponent<P> | undefined;
  return function Lazy(props: P) {
    const found = useSignal<FunctionComponent<P> | undefined>(loaded);
    const failed = useSignal(false);
    useEffect(() => {
      if (loaded) return;
      load().then(
        (component) => {
          loaded = component;
          found.value = component;
        },
        () => {
          failed.value = true;
        },
      );
    }, []);
    const Found = found.value;
    if (failed.value) return <p role="alert">This part could not be fetched from the server.</p>;
    return Found ? <Found {...props} /> : null;
  };
}
