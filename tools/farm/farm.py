"""voxilux farm: renders a picture or a film on the workers of a Dask cluster. The binary starts this with one argument,
the number of an open file that holds the job as JSON."""

import json
import os
import signal
import sys

from farm_job import Stop, say
from farm_loop import Farm

SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


def listen(farm: Farm) -> None:
    """Makes the first signal end the job in order, and the second one end it at once."""
    def interrupt(*_: object) -> None:
        farm.signals += 1
        if farm.signals > 1:
            os._exit(130)

    for number in SIGNALS:
        signal.signal(number, interrupt)


def is_of_network(cause: OSError) -> bool:
    """Whether the error is that of a cluster, which may be back later, and not of our files or of a closed pipe."""
    is_lost = isinstance(cause, (ConnectionError, TimeoutError)) and not isinstance(cause, BrokenPipeError)
    return is_lost or type(cause).__module__.startswith("distributed.")  # such as its CommClosedError


def rest_of(farm: Farm | None) -> str:
    """What a stopped job lacks, in words."""
    return "nothing is done" if farm is None else f"{farm.missing()}; --resume goes on"


def farm_main(options: dict) -> int:
    """The exit code."""
    farm = None
    try:
        farm = Farm(options)
        farm.open_cluster()
        listen(farm)
        return farm.run()
    except Stop as stop:
        say(str(stop) if farm is None or farm.cluster is None else f"{stop}; {rest_of(farm)}")
        return stop.code
    except OSError as cause:
        say(f"{cause}; {rest_of(farm)}")
        return 75 if is_of_network(cause) else 73
    except Exception as cause:  # noqa: BLE001  a fault of ours, or of Dask
        say(f"internal error: {type(cause).__name__}: {' '.join(str(cause).split())}; {rest_of(farm)}")
        return 70
    finally:
        if farm is not None and farm.cluster is not None:
            farm.cluster.close()


def main() -> None:
    for number in SIGNALS:
        signal.signal(number, signal.SIG_IGN)  # inherited by the workers, because a terminal signals them, too
    globals().pop("__file__", None)  # it is "<stdin>", which new processes would try to open
    with open(int(sys.argv[1]), encoding="utf-8") as job:
        code = farm_main(json.load(job))
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)  # without waiting for threads that Dask still has


if __name__ == "__main__":
    main()
