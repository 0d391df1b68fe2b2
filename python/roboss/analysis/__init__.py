"""Analysis: recordings of runs, pictures and reports of them. `roboss record`, `plot` and `analyse` are its commands.

    >>> from roboss import analysis
    >>> recording = analysis.record(roboss.example("crossroads.sdf"), ["car_3.pose", "car_3.speed"], until=0.2)
    >>> recording["car_3.pose"].shape
    (21, 7)

Formulas are functions of arrays, without a simulation: `iso9283` (arms), `vehicle`, `walker`; `calibration` fits numbers of
a world file to recorded runs. docs/analysis.md lists them with their sources. Files need the extra `analysis` of the
package (pyarrow, mcap, matplotlib, scipy).
"""
from .arm import Condition, analyse_arm
from .recorder import Recorded, record, record_file
from .recording import Column, Recording, read, write
from .ros2_recorder import record_ros2
from .variables import Variables

__all__ = ["Column", "Condition", "Recorded", "Recording", "Variables", "analyse_arm", "read", "record", "record_file",
           "record_ros2", "write"]
