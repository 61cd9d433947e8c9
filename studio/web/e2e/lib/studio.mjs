// The program under test.
import { spawn, spawnSync } from "node:child_process";
import { resolve } from "node:path";

/** Runs a command to its end; throws with its messages if it fails. */
export function asperity(binary, args, folder) {
  const run = spawnSync(resolve(binary), args, { cwd: folder, encoding: "utf8" });
  if (run.status !== 0) throw new Error(`asperity ${args.join(" ")} ended with ${run.status ?? run.error}:\n${run.stderr}`);
  return run.stdout;
}

/** A running studio in a folder: its address with the token, and its end. `state`: where it keeps the user's list of projects. */
export async function startStudio(binary, folder, args = [], { state = `${folder}-state` } = {}) {
  const child = spawn(resolve(binary), ["studio", "--no-open", ...args], { cwd: folder, stdio: ["ignore", "pipe", "pipe"], env: { ...process.env, XDG_STATE_HOME: state } });
  let said = "";
  let faults = "";
  child.stderr.on("data", (chunk) => (faults += chunk));
  const ended = new Promise((resolve) => child.once("exit", (code, signal) => resolve(code ?? signal)));
  const address = await new Promise((resolve, reject) => {
    child.stdout.on("data", (chunk) => {
      said += chunk;
      const found = /http:\/\/\S+#token=\S+/.exec(said);
      if (found) resolve(found[0]);
    });
    ended.then((code) => reject(new Error(`asperity studio ended with ${code}: ${faults}`)));
  });
  return {
    address,
    origin: new URL(address).origin,
    port: Number(new URL(address).port),
    faults: () => faults,
    /** Ends it as Ctrl-C does; gives its exit code. */
    async stop(signal = "SIGINT") {
      child.kill(signal);
      return ended;
    },
  };
}
