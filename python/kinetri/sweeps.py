# SPDX-License-Identifier: GPL-3.0-or-later
"""Many runs: a parameter study on processes of this machine, or on a cluster."""
from __future__ import annotations

import concurrent.futures
import itertools
import multiprocessing
import pickle
from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, Any

from .errors import PreconditionError, WorkerError

if TYPE_CHECKING:
    import pandas as pd

#: The number of times that a task is run if its worker ends without a result.
MOST_ATTEMPTS = 3


def parameter_list(
        parameters: dict[str, Sequence[Any]] | Iterable[dict[str, Any]]) -> list[dict[str, Any]]:
    """The runs of a sweep, in order.

    For runs that `sweep` does not start itself, such as the tasks of a job array.

    Parameters
    ----------
    parameters : dict of sequences, or iterable of dict
        A dictionary of sequences means all combinations of their values, the last name varying fastest.

    Returns
    -------
    list of dict
        The arguments of each run.

    Raises
    ------
    PreconditionError
        If it is neither.

    Examples
    --------
    >>> import kinetri
    >>> kinetri.parameter_list({"share": [0.1, 0.2], "seed": [1]})
    [{'share': 0.1, 'seed': 1}, {'share': 0.2, 'seed': 1}]
    """
    if isinstance(parameters, dict):
        names = list(parameters)
        try:
            values = [list(parameters[name]) for name in names]
        except TypeError:
            raise PreconditionError(
                "parameters is a dictionary whose values are not all sequences; expected "
                "{'seed': range(10), 'points': [100]}, for example") from None
        return [dict(zip(names, combination)) for combination in itertools.product(*values)]
    result = list(parameters)
    for i, run in enumerate(result):
        if not isinstance(run, dict):
            raise PreconditionError(
                f"parameters[{i}] is {run!r}; expected a dictionary of arguments of the function")
    return result


def _dumps(value: Any) -> bytes:
    """Pickles a task; functions of a notebook too, if cloudpickle is installed."""
    try:
        import cloudpickle
    except ImportError:
        return pickle.dumps(value)
    return bytes(cloudpickle.dumps(value))


def _called(function: Callable[..., Any], arguments: dict[str, Any]) -> Any:
    return function(**arguments)


def _call(task: bytes) -> Any:
    return _called(*pickle.loads(task))


def _map_on_client(function: Callable[..., Any], argument_list: list[dict[str, Any]],
                   client: Any) -> list[Any]:
    from distributed.scheduler import KilledWorker

    # Tasks are distinct even if equal; dask runs a task again if its worker is killed.
    # Arguments in one tuple, since `submit` has keywords of its own.
    futures = [client.submit(_called, function, arguments, pure=False) for arguments in argument_list]
    try:
        return list(client.gather(futures))
    except KilledWorker as error:
        raise WorkerError(f"{error}; expected enough memory for a run on each worker") from error


def map_on_processes(tasks: list[bytes], workers: int | None = None) -> list[Any]:
    """The results of pickled tasks, in order, on processes of this machine.

    If a worker is killed, its tasks and those that were lost with it run again.
    """
    results = {}
    remaining = dict(enumerate(tasks))
    # A forked process would inherit the parent's locks, but not its threads.
    context = multiprocessing.get_context("spawn")
    for _ in range(MOST_ATTEMPTS):
        if not remaining:
            break
        with concurrent.futures.ProcessPoolExecutor(workers, mp_context=context) as pool:
            futures = {pool.submit(_call, task): i for i, task in remaining.items()}
            try:
                for future in concurrent.futures.as_completed(futures):
                    try:
                        results[futures[future]] = future.result()
                    except concurrent.futures.process.BrokenProcessPool:
                        continue
                    del remaining[futures[future]]
            except BaseException:
                pool.shutdown(cancel_futures=True)
                raise
    if remaining:
        raise WorkerError(
            f"{len(remaining)} of {len(tasks)} runs ended without a result, {MOST_ATTEMPTS} times: their "
            "processes were killed, or could not begin; expected enough memory for a run on each processor, "
            "or fewer workers; and, in a script, the call below if __name__ == '__main__':")
    return [results[i] for i in range(len(tasks))]


def map_tasks(function: Callable[..., Any], argument_list: list[dict[str, Any]], client: Any,
              workers: int | None) -> list[Any]:
    """The results of function(**arguments), in order, on a client or on processes."""
    if client is not None:
        return _map_on_client(function, argument_list, client)
    tasks = [_dumps((function, arguments)) for arguments in argument_list]
    return map_on_processes(tasks, workers)


def sweep(function: Callable[..., Any],
          parameters: dict[str, Sequence[Any]] | Iterable[dict[str, Any]], client: Any = None, *,
          workers: int | None = None) -> pd.DataFrame:
    """Runs a function with many sets of arguments, and returns the results as one table.

    Parameters
    ----------
    function : callable
        Called with the arguments of each run. It returns a dictionary (a row), a pandas.DataFrame or a list of
        dictionaries (rows), or a value (a row with the column `result`). Processes must be able to import it;
        functions of a notebook need cloudpickle, or a client.
    parameters : dict of sequences, or iterable of dict
        As in `parameter_list`.
    client : dask.distributed.Client, optional
        Where to run; by default on processes of this machine.
    workers : int, optional
        The number of processes, without a client; by default one for each processor.

    Returns
    -------
    pandas.DataFrame
        In the order of the parameters: a column for each parameter, then those of the results. The same for any
        number of workers.

    Raises
    ------
    WorkerError
        If a task's worker is killed repeatedly. After the first times the task runs again.
    Exception
        What the function raises.

    Notes
    -----
    Without a client, a script must make the call under ``if __name__ == "__main__":``, since the
    processes import it.
    """
    runs = parameter_list(parameters)
    return result_table(runs, map_tasks(function, runs, client, workers))


def result_table(runs: Sequence[dict[str, Any]], results: Sequence[Any]) -> pd.DataFrame:
    """The table of `sweep` from the results of runs.

    Parameters
    ----------
    runs : sequence of dict
        The arguments of each run, as `parameter_list` gives them.
    results : sequence
        The results of the function for each run, as in `sweep`.

    Returns
    -------
    pandas.DataFrame
        In the order of the runs: a column for each argument, then those of the results.

    Raises
    ------
    PreconditionError
        If there are not as many results as runs.

    Examples
    --------
    >>> import kinetri
    >>> runs = kinetri.parameter_list({"share": [0.1, 0.2], "seed": [1]})
    >>> kinetri.result_table(runs, [{"pressure": 1.2}, {"pressure": 1.5}])
       share  seed  pressure
    0    0.1     1       1.2
    1    0.2     1       1.5
    """
    import pandas as pd

    if len(runs) != len(results):
        raise PreconditionError(
            f"there are {len(results)} results; expected one for each of {len(runs)} runs")
    tables = []
    for arguments, result in zip(runs, results):
        if isinstance(result, pd.DataFrame):
            table = result.reset_index(drop=True)
        elif isinstance(result, dict):
            table = pd.DataFrame([result])
        elif isinstance(result, list) and all(isinstance(row, dict) for row in result):
            table = pd.DataFrame(result)
        else:
            table = pd.DataFrame({"result": [result]})
        for position, (name, value) in enumerate(arguments.items()):
            if name not in table.columns:
                table.insert(position, name, [value] * len(table))
        tables.append(table)
    return pd.concat(tables, ignore_index=True) if tables else pd.DataFrame()
