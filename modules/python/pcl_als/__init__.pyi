# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
# Made by share/dev/python_stubs.py; not to be edited.
import os
import pathlib
from typing import Any, Callable, Iterable, Mapping, Optional, Union, overload

import numpy
from numpy.typing import ArrayLike

_Path = Union[str, os.PathLike]

__version__: str

__all__: list[str]

class Alignment:
    """The rigid motion of a source onto a target, about the centroid of their overlap. Order of
    parameters: XT, YT, ZT (m), omega, phi, kappa (rad)."""
    @property
    def converged(self) -> bool: ...
    @property
    def covariance(self) -> numpy.ndarray:
        """6 x 6; m^2, m rad, rad^2"""
    @property
    def pairs(self) -> int: ...
    @property
    def reason(self) -> str:
        """why the result is not reliable; empty where it is"""
    @property
    def reliable(self) -> bool:
        """converged, and every parameter is determined"""
    @property
    def rms_after(self) -> float:
        """normal distances with the estimated motion, m"""
    @property
    def rms_before(self) -> float:
        """normal distances with the initial motion, m"""
    @property
    def scale(self) -> float: ...
    @property
    def sigma0(self) -> float:
        """m"""
    @property
    def std(self) -> numpy.ndarray:
        """their standard deviations; NaN: not determined"""
    def to_dict(self) -> Any:
        """The content of the result file of pcl_als_icpatch as dictionaries and lists."""
    def to_frame(self) -> Any:
        """The six parameters as a pandas.DataFrame; as a dictionary of columns where pandas is
        missing."""
    @property
    def transformation(self) -> numpy.ndarray:
        """4 x 4, from source to target, ground frame"""
    @property
    def values(self) -> numpy.ndarray:
        """the six parameters"""

class AlignmentSettings:
    """Settings of ICPatch; attributes may be given as keywords."""
    def __init__(self, **kwargs) -> None: ...
    @property
    def determined_std(self) -> float:
        """above, a parameter is not determined; m at the radius of the overlap"""
    @determined_std.setter
    def determined_std(self, value: float) -> None: ...
    @property
    def estimate_scale(self) -> bool: ...
    @estimate_scale.setter
    def estimate_scale(self, value: bool) -> None: ...
    @property
    def maximum_iterations(self) -> int: ...
    @maximum_iterations.setter
    def maximum_iterations(self, value: int) -> None: ...
    @property
    def pairs(self) -> int:
        """candidates in each direction"""
    @pairs.setter
    def pairs(self, value: int) -> None: ...
    @property
    def points(self) -> int:
        """triangulated points of each strip"""
    @points.setter
    def points(self, value: int) -> None: ...
    @property
    def search_distance(self) -> float:
        """largest distance of the surfaces at the start, m"""
    @search_distance.setter
    def search_distance(self, value: float) -> None: ...
    @property
    def threads(self) -> int: ...
    @threads.setter
    def threads(self, value: int) -> None: ...

class Atmosphere:
    """The air as a weather station reports it."""
    def __init__(self, **kwargs) -> None: ...
    @property
    def extinction_per_km(self) -> float:
        """one way"""
    @property
    def pressure_kpa(self) -> float: ...
    @pressure_kpa.setter
    def pressure_kpa(self, value: float) -> None: ...
    @property
    def relative_humidity(self) -> float:
        """percent"""
    @relative_humidity.setter
    def relative_humidity(self, value: float) -> None: ...
    @property
    def temperature_c(self) -> float: ...
    @temperature_c.setter
    def temperature_c(self, value: float) -> None: ...
    @property
    def visibility_km(self) -> float: ...
    @visibility_km.setter
    def visibility_km(self, value: float) -> None: ...
    @property
    def wavelength_nm(self) -> float:
        """of the laser"""
    @wavelength_nm.setter
    def wavelength_nm(self, value: float) -> None: ...

class CalibrationResult:
    """The content of a calibration.json."""
    @property
    def attitude(self) -> str:
        """source of the attitude of the model: 'none', 'points', 'trajectory' or 'nominal'"""
    @property
    def control(self) -> list[ControlFit]:
        """fit of each strip to control"""
    @property
    def converged(self) -> bool: ...
    @property
    def correlation(self) -> numpy.ndarray:
        """of the estimated parameters; a new array"""
    @property
    def correlation_order(self) -> list[str]:
        """names of the rows and columns of correlation"""
    @property
    def crs(self) -> str:
        """of the ground frame, WKT or an EPSG code; empty: not known"""
    @property
    def diagnosis(self) -> list[ErrorFinding]:
        """possible causes of the misfit"""
    @property
    def inputs(self) -> list[str]:
        """names of files"""
    def instrument(self) -> CalibrationResult:
        """The part that belongs to the instrument and applies to its other flights."""
    @property
    def left_out(self) -> list[LeftOutPoints]: ...
    @property
    def misfit(self) -> MisfitChange: ...
    @property
    def observability(self) -> list[str]:
        """what is weakly determined, why, and what would help"""
    @property
    def pairs(self) -> list[PairFit]: ...
    @property
    def parameters(self) -> dict[str, Parameter]:
        """the eight system parameters by name, such as 'boresight_roll'"""
    @property
    def redundancy(self) -> int: ...
    @property
    def sigma0(self) -> float:
        """standard deviation of unit weight, 1"""
    @property
    def systems(self) -> list[SystemEstimate]:
        """all systems where there are several; parameters are those of the first one"""
    def to_dict(self) -> Any:
        """The content of calibration.json as dictionaries and lists; angles in arc-seconds."""
    def to_frame(self, table: str = 'parameters') -> Any:
        """A table as a pandas.DataFrame; as a dictionary of columns where pandas is missing.
        table: 'parameters', 'pairs', 'control' or 'diagnosis'."""
    @property
    def verdict(self) -> CalibrationVerdict: ...
    @property
    def warnings(self) -> list[str]: ...
    def write(self, path: _Path) -> None:
        """Writes calibration.json; the file appears when it is complete."""

class CalibrationSettings:
    """Settings of a calibration; the defaults suit post-processed flights of 500 to 3000 m
    height. Attributes may be given as keywords."""
    def __init__(self, **kwargs) -> None: ...
    @property
    def candidates(self) -> int:
        """points of all areas together that may form pairs"""
    @candidates.setter
    def candidates(self, value: int) -> None: ...
    @property
    def control_sigma(self) -> float:
        """standard deviation of control points whose file gives none, m"""
    @control_sigma.setter
    def control_sigma(self, value: float) -> None: ...
    @property
    def diagnose(self) -> bool:
        """look for further error sources"""
    @diagnose.setter
    def diagnose(self, value: bool) -> None: ...
    @property
    def estimate(self) -> list[str]:
        """names of the parameters to estimate; empty: all that the data determine"""
    @estimate.setter
    def estimate(self, value: Iterable[str]) -> None: ...
    @property
    def fixed(self) -> list[str]:
        """strips that are held fixed: an earlier delivery, which is not corrected"""
    @fixed.setter
    def fixed(self, value: Iterable[str]) -> None: ...
    @property
    def fixed_sigma(self) -> float:
        """standard deviation of the error that fixed strips share, m, each axis"""
    @fixed_sigma.setter
    def fixed_sigma(self, value: float) -> None: ...
    @property
    def force(self) -> bool:
        """continue with a trajectory that cannot belong to the points"""
    @force.setter
    def force(self, value: bool) -> None: ...
    @property
    def max_iterations(self) -> int: ...
    @max_iterations.setter
    def max_iterations(self, value: int) -> None: ...
    @property
    def max_normal_distance(self) -> float:
        """of a pair at the start, m"""
    @max_normal_distance.setter
    def max_normal_distance(self, value: float) -> None: ...
    @property
    def minimum_overlap(self) -> float:
        """of a pair of strips, m^2"""
    @minimum_overlap.setter
    def minimum_overlap(self, value: float) -> None: ...
    @property
    def minimum_points(self) -> int:
        """strips with fewer points are excluded"""
    @minimum_points.setter
    def minimum_points(self, value: int) -> None: ...
    @property
    def noise(self) -> NoiseModel: ...
    @noise.setter
    def noise(self, value: NoiseModel) -> None: ...
    @property
    def own(self) -> list[str]:
        """what systems have of their own: names of parameters, 'boresight', 'lever_arm',
        'offset'"""
    @own.setter
    def own(self, value: Iterable[str]) -> None: ...
    @property
    def pair_budget(self) -> int:
        """largest number of pairs that are adjusted; 0: all"""
    @pair_budget.setter
    def pair_budget(self, value: int) -> None: ...
    @property
    def point_budget(self) -> int:
        """largest number of points in the areas that are used"""
    @point_budget.setter
    def point_budget(self, value: int) -> None: ...
    @property
    def recover_attitude(self) -> bool:
        """recover pitch and crab from the points where the trajectory has no attitude"""
    @recover_attitude.setter
    def recover_attitude(self, value: bool) -> None: ...
    @property
    def shared_errors(self) -> SharedErrorModel: ...
    @shared_errors.setter
    def shared_errors(self, value: SharedErrorModel) -> None: ...
    @property
    def systems(self) -> list[tuple[str, list[str]]]:
        """systems with parameters of their own: name and strips of each; empty: one"""
    @systems.setter
    def systems(self, value: Iterable[tuple[str, Iterable[str]]]) -> None: ...
    @property
    def threads(self) -> int:
        """0: all cores; results do not depend on it"""
    @threads.setter
    def threads(self, value: int) -> None: ...

class CalibrationVerdict:
    """Whether a calibration may be applied."""
    @property
    def reason(self) -> str: ...
    @property
    def status(self) -> str:
        """'usable', 'parameters_affected', 'no_improvement', 'not_determined' or
        'not_converged'"""
    @property
    def usable(self) -> bool: ...

class Cancelled(Error):
    """A progress callback returned False. Nothing half written is left."""

class CheckResult:
    """The result of a delivery check."""
    @property
    def before(self) -> Optional[CheckedBlock]:
        """the same strips before; None without"""
    @property
    def block(self) -> CheckedBlock:
        """the set that was checked"""
    @property
    def kept(self) -> bool:
        """whether the delivery keeps the required level: every overlapping pair is measured and
        within the limit, and so is control where it was given"""
    @property
    def not_kept_because(self) -> list[str]:
        """why the delivery does not keep the required level: every pair and figure"""
    @property
    def quality_level(self) -> int:
        """that was required"""
    @property
    def reason(self) -> str:
        """why there is none; empty where there is one"""
    @property
    def reliable(self) -> bool:
        """whether there is a reliable result: an assessed pair, or a control point"""
    def to_dict(self) -> Any:
        """The content of quality.json as dictionaries and lists."""
    def to_frame(self) -> Any:
        """The pairs of strips as a pandas.DataFrame; as a dictionary of columns where pandas is
        missing."""

class CheckSettings:
    """Settings of a check; attributes may be given as keywords."""
    def __init__(self, **kwargs) -> None: ...
    @property
    def candidates(self) -> int:
        """places of comparison"""
    @candidates.setter
    def candidates(self, value: int) -> None: ...
    @property
    def control_sigma(self) -> float:
        """standard deviation of control points whose file gives none, m"""
    @control_sigma.setter
    def control_sigma(self, value: float) -> None: ...
    @property
    def force(self) -> bool: ...
    @force.setter
    def force(self, value: bool) -> None: ...
    @property
    def maximum_distance(self) -> float:
        """larger offsets count as different objects, m"""
    @maximum_distance.setter
    def maximum_distance(self, value: float) -> None: ...
    @property
    def minimum_overlap(self) -> float:
        """m^2"""
    @minimum_overlap.setter
    def minimum_overlap(self, value: float) -> None: ...
    @property
    def minimum_points(self) -> int: ...
    @minimum_points.setter
    def minimum_points(self, value: int) -> None: ...
    @property
    def point_budget(self) -> int:
        """largest number of points in the areas that are compared"""
    @point_budget.setter
    def point_budget(self, value: int) -> None: ...
    @property
    def threads(self) -> int: ...
    @threads.setter
    def threads(self, value: int) -> None: ...

class CheckedBlock:
    """One set of strips in a check."""
    @property
    def control(self) -> Optional[OffsetSummary]:
        """strips minus control points; None without control"""
    @property
    def files(self) -> list[str]: ...
    @property
    def left_out(self) -> list[LeftOutPoints]: ...
    @property
    def pairs(self) -> list[CheckedPair]: ...
    @property
    def strips(self) -> list[str]: ...
    def to_frame(self) -> Any:
        """The pairs of strips as a pandas.DataFrame; as a dictionary of columns where pandas is
        missing."""
    @property
    def warnings(self) -> list[str]: ...

class CheckedPair:
    """Agreement of two overlapping strips; signs are those of a - b."""
    @property
    def a(self) -> str: ...
    @property
    def b(self) -> str: ...
    @property
    def horizontal(self) -> HorizontalShift: ...
    @property
    def normal(self) -> OffsetSummary:
        """distances along the normals of all smooth surfaces"""
    @property
    def overlap_area(self) -> float:
        """m^2"""
    @property
    def quality_level(self) -> Optional[int]:
        """of the USGS Lidar Base Specification by vertical.rms; None: none"""
    @property
    def reason(self) -> str: ...
    @property
    def sampled_offsets(self) -> list[float]:
        """vertical offsets at up to 5000 places, for plots; m"""
    @property
    def status(self) -> str:
        """'judged', or why not"""
    @property
    def vertical(self) -> OffsetSummary:
        """height differences on smooth ground below 10 degrees"""

class ClassModel:
    """Statistics of classes: normal distributions over the bands of rasters."""
    @property
    def bands(self) -> list[str]: ...
    @property
    def classes(self) -> list[str]:
        """names"""
    def covariance(self, index: int) -> numpy.ndarray:
        """Covariance of a class, bands x bands; a new array."""
    def mean(self, index: int) -> numpy.ndarray:
        """Mean of a class by band, in the units of the bands; a new array."""
    def statistics(self, index: int) -> ClassStatistics:
        """Statistics of a class."""
    def write(self, path: _Path) -> None: ...

class ClassStatistics:
    """A class as a normal distribution over bands."""
    @property
    def covariance(self) -> numpy.ndarray:
        """bands x bands"""
    @property
    def mean(self) -> numpy.ndarray:
        """by band, in the units of the bands"""
    @property
    def name(self) -> str: ...
    @property
    def prior(self) -> float:
        """probability"""
    @property
    def samples(self) -> int:
        """from which it was estimated"""

class ControlFit:
    """Heights of a strip above control points; m."""
    @property
    def mean_after(self) -> float: ...
    @property
    def mean_before(self) -> float: ...
    @property
    def points(self) -> int: ...
    @property
    def rms_after(self) -> float: ...
    @property
    def rms_before(self) -> float: ...
    @property
    def strip(self) -> str: ...

class ControlPoint:
    """A surveyed point on the ground, used vertically, or the centre of a target."""
    def __init__(self, id: str, x: float, y: float, z: float, sigma: float = 0.0, diameter: float = 0.0, sigma_plan: float = 0.0) -> None: ...
    @property
    def diameter(self) -> float:
        """of a level circular target, m; 0: not a target"""
    @property
    def id(self) -> str: ...
    @property
    def sigma(self) -> float:
        """standard deviation of the height, m; 0: not stated"""
    @property
    def sigma_plan(self) -> float:
        """standard deviation of x and of y of a target, m; 0: that of the height"""
    @property
    def x(self) -> float:
        """m"""
    @property
    def y(self) -> float:
        """m"""
    @property
    def z(self) -> float:
        """m"""

class ConvertedFile:
    """A file of convert()."""
    @property
    def path(self) -> pathlib.Path: ...
    @property
    def points(self) -> int:
        """number of points"""

class Error(Exception):
    """Base of the exceptions of this package. The message is one line that names the file,
    record or argument; remedy is the name of the argument that may be set about it, or None."""
    remedy: Optional[str]

class ErrorFinding:
    """A possible cause of the misfit of strips."""
    @property
    def corrected(self) -> bool: ...
    @property
    def determined(self) -> bool: ...
    @property
    def effect(self) -> float:
        """on the ground at the edge of the swath, m"""
    @property
    def evidence(self) -> str: ...
    @property
    def probability(self) -> float:
        """that the error is present"""
    @property
    def remedy(self) -> str: ...
    @property
    def source(self) -> str: ...
    @property
    def std(self) -> float: ...
    @property
    def title(self) -> str: ...
    @property
    def unit(self) -> str:
        """of value and std"""
    @property
    def value(self) -> float:
        """assumed - true, where it is present"""

class FileCorrection:
    """What correct_file() did."""
    @property
    def attitude_remark(self) -> str:
        """recovery of pitch and crab from this file, where the calibration has none"""
    @property
    def flight_remark(self) -> str:
        """that the calibration is of another flight, whose own part is not used"""
    @property
    def points(self) -> int:
        """number of points"""
    @property
    def time_remark(self) -> str:
        """how the times of the points were reconciled with those of the trajectory"""
    @property
    def uncovered(self) -> int:
        """points without trajectory, which are unchanged"""
    @property
    def warnings(self) -> list[str]: ...

class Flight:
    """A trajectory in the ground frame of the points. Times are seconds on its own clock; jobs
    reconcile the times of points with it."""
    def __init__(self, samples: ArrayLike) -> None:
        """From an array of n x 4 (time in s; easting, northing, height in m) or n x 7 (also
        roll, pitch, heading in radians: right wing down, nose up, clockwise from grid north).
        InputError where no path follows from it."""
    def __len__(self) -> int: ...
    @property
    def end_time(self) -> float:
        """s"""
    @property
    def format(self) -> str:
        """'SBET', 'text', ..."""
    @property
    def frame(self) -> str:
        """coordinates and datum of the file"""
    @property
    def has_attitude(self) -> bool:
        """whether roll, pitch and heading are used"""
    @property
    def reconstructed(self) -> bool:
        """whether it was reconstructed from points"""
    @property
    def remarks(self) -> list[str]:
        """conversions and repairs"""
    @property
    def samples(self) -> numpy.ndarray:
        """n x 7: time (s), x, y, z (m), roll, pitch, heading (rad; NaN: none); a new array"""
    @property
    def start_time(self) -> float:
        """s"""
    def to_frame(self) -> Any:
        """The samples as a pandas.DataFrame; as a dictionary of columns where pandas is
        missing."""

class FlightLine:
    """A planned flight line, straight and level; attributes may be given as keywords."""
    def __init__(self, **kwargs) -> None: ...
    @property
    def density(self) -> float:
        """pulses per square metre"""
    @density.setter
    def density(self, value: float) -> None: ...
    @property
    def end(self) -> numpy.ndarray:
        """east, north, m"""
    @end.setter
    def end(self, value: ArrayLike) -> None: ...
    @property
    def half_angle(self) -> float:
        """half the field of view, rad"""
    @half_angle.setter
    def half_angle(self, value: float) -> None: ...
    @property
    def height(self) -> float:
        """above mean ground, m"""
    @height.setter
    def height(self, value: float) -> None: ...
    @property
    def id(self) -> str: ...
    @id.setter
    def id(self, value: str) -> None: ...
    @property
    def speed(self) -> float:
        """m/s"""
    @speed.setter
    def speed(self, value: float) -> None: ...
    @property
    def start(self) -> numpy.ndarray:
        """east, north, m, any local frame"""
    @start.setter
    def start(self, value: ArrayLike) -> None: ...

class HorizontalShift:
    """Movement of strip a onto strip b, m."""
    @property
    def determined(self) -> bool: ...
    @property
    def reason(self) -> str:
        """why it is not determined"""
    @property
    def shift(self) -> numpy.ndarray:
        """east, north, up"""
    @property
    def std(self) -> numpy.ndarray: ...

class InputError(Error, OSError):
    """Input that cannot be used: missing, corrupt, without times, without overlap; also an
    OSError, as Python's own errors of files are."""

class IntensityOutput:
    """What is written besides the intensity."""
    def __init__(self, **kwargs) -> None: ...
    @property
    def extra_fields(self) -> bool:
        """range, incidence_angle, and reflectance where it is known"""
    @extra_fields.setter
    def extra_fields(self, value: bool) -> None: ...
    @property
    def keep_original(self) -> bool:
        """as extra field original_intensity"""
    @keep_original.setter
    def keep_original(self, value: bool) -> None: ...
    @property
    def scale(self) -> float:
        """factor in the 16-bit field"""
    @scale.setter
    def scale(self, value: float) -> None: ...

class IntensityResult:
    """The result of a radiometric correction."""
    @property
    def gains(self) -> dict[str, float]:
        """divisor of the intensities of each strip"""
    @property
    def left_out(self) -> list[LeftOutPoints]: ...
    @property
    def model(self) -> RadiometricModel:
        """as it was used, with the estimated terms"""
    @property
    def points_by_status(self) -> dict[str, int]: ...
    @property
    def reason(self) -> str:
        """why the result is not reliable; empty where it is"""
    @property
    def reliable(self) -> bool: ...
    def to_dict(self) -> Any:
        """The content of the JSON file of pcl_als_intensity as dictionaries and lists."""
    def to_frame(self) -> Any:
        """The gains of the strips as a pandas.DataFrame; as a dictionary of columns where
        pandas is missing."""
    @property
    def warnings(self) -> list[str]: ...

class IntensitySettings:
    """Settings of a radiometric correction; attributes may be given as keywords."""
    def __init__(self, **kwargs) -> None: ...
    @property
    def cell(self) -> float:
        """of the comparison of strips, m; 0: from the density"""
    @cell.setter
    def cell(self, value: float) -> None: ...
    @property
    def estimate(self) -> list[str]:
        """terms to estimate from overlaps: 'range_exponent', 'incidence_exponent',
        'extinction', 'strip_gains'"""
    @estimate.setter
    def estimate(self, value: Iterable[str]) -> None: ...
    @property
    def footprint_mrad(self) -> float:
        """divergence of the beam"""
    @footprint_mrad.setter
    def footprint_mrad(self, value: float) -> None: ...
    @property
    def force(self) -> bool: ...
    @force.setter
    def force(self, value: bool) -> None: ...
    @property
    def gains(self) -> dict[str, float]:
        """known gains by strip; intensities are divided by them"""
    @gains.setter
    def gains(self, value: dict[str, float]) -> None: ...
    @property
    def gps_week(self) -> Optional[int]: ...
    @gps_week.setter
    def gps_week(self, value: Optional[int]) -> None: ...
    @property
    def keep_uncovered(self) -> bool:
        """any number of points without trajectory stay unchanged, else at most 1 %"""
    @keep_uncovered.setter
    def keep_uncovered(self, value: bool) -> None: ...
    @property
    def model(self) -> RadiometricModel: ...
    @model.setter
    def model(self, value: RadiometricModel) -> None: ...
    @property
    def pulse_rates(self) -> dict[str, float]:
        """by strip, Hz"""
    @pulse_rates.setter
    def pulse_rates(self, value: dict[str, float]) -> None: ...
    @property
    def saturation(self) -> float:
        """digital number; 0: 255 or 65535"""
    @saturation.setter
    def saturation(self, value: float) -> None: ...
    @property
    def strips(self) -> StripChoice:
        """points of other strips stay unchanged"""
    @strips.setter
    def strips(self, value: StripChoice) -> None: ...
    @property
    def threads(self) -> int: ...
    @threads.setter
    def threads(self, value: int) -> None: ...

class LandCover:
    """The result of classify()."""
    @property
    def cells(self) -> list[int]:
        """cells of the map by class, in the order of model.classes"""
    @property
    def confusion(self) -> Optional[numpy.ndarray]:
        """numbers of check sites, [classified, reference]; None without them"""
    @property
    def model(self) -> ClassModel:
        """given or trained; None where only rasters were made"""
    @property
    def overall_accuracy(self) -> Optional[float]:
        """share of the check sites that are classified correctly; None without them"""
    @property
    def reliable(self) -> bool: ...
    @property
    def remarks(self) -> list[str]: ...
    def to_dict(self) -> Any:
        """The content of accuracy.json as dictionaries and lists; empty without check sites."""
    def to_frame(self) -> Any:
        """The cells of each class as a pandas.DataFrame; as a dictionary of columns where
        pandas is missing."""
    @property
    def undetermined(self) -> list[str]:
        """classes whose training samples do not suffice"""

class LeftOutPoints:
    """Points of a strip that took no part, and why."""
    @property
    def of(self) -> int:
        """points of the strip"""
    @property
    def points(self) -> int:
        """number of points that were excluded"""
    @property
    def reason(self) -> str:
        """'excluded', 'before_trajectory', 'too_few_points', ..."""
    @property
    def strip(self) -> str: ...

class MisfitChange:
    """Misfit of overlapping strips before and after, at the same points, along the normals;
    m."""
    @property
    def change_std(self) -> float:
        """standard deviation of the change of the RMS"""
    @property
    def points(self) -> int: ...
    @property
    def rms_after(self) -> float: ...
    @property
    def rms_before(self) -> float: ...

class NoiseModel:
    """Random errors of one return (standard deviations)."""
    def __init__(self, **kwargs) -> None: ...
    @property
    def angle(self) -> float:
        """pointing, each axis, rad"""
    @angle.setter
    def angle(self, value: float) -> None: ...
    @property
    def beam_divergence(self) -> float:
        """full angle at 1/e^2, rad"""
    @beam_divergence.setter
    def beam_divergence(self, value: float) -> None: ...
    @property
    def position(self) -> float:
        """short-term trajectory noise, m"""
    @position.setter
    def position(self, value: float) -> None: ...
    @property
    def range(self) -> float:
        """along the beam, m"""
    @range.setter
    def range(self, value: float) -> None: ...

class OffsetSummary:
    """Statistics of offsets, m."""
    @property
    def count(self) -> int: ...
    @property
    def largest(self) -> float:
        """absolute value"""
    @property
    def mean(self) -> float: ...
    @property
    def median(self) -> float: ...
    @property
    def nmad(self) -> float:
        """1.4826 times the median absolute deviation"""
    @property
    def percentile_95(self) -> float:
        """of the absolute values"""
    @property
    def rms(self) -> float: ...
    @property
    def std(self) -> float: ...
    @property
    def std_of_mean(self) -> float:
        """allows for errors that places of an area have in common; NaN: unknown"""

class Orientation:
    """The result of orient()."""
    @property
    def reason(self) -> str: ...
    @property
    def reliable(self) -> bool: ...
    @property
    def sigma0(self) -> float: ...
    def to_dict(self) -> Any:
        """The content of orientation.json as dictionaries and lists."""

POINT: numpy.dtype

class PairFit:
    """Normal distances of the points of a pair of strips to the patches of the other strip;
    m."""
    @property
    def a(self) -> str: ...
    @property
    def b(self) -> str: ...
    @property
    def correspondences(self) -> int: ...
    @property
    def mean_after(self) -> float: ...
    @property
    def mean_before(self) -> float: ...
    @property
    def rms_after(self) -> float: ...
    @property
    def rms_before(self) -> float: ...

class Parameter:
    """A system parameter of a calibration."""
    @property
    def bias(self) -> float:
        """assumed - true"""
    @property
    def determined(self) -> bool:
        """False for an estimate that tells nothing: within two standard deviations of zero, one
        of which moves points by more than 8 cm"""
    @property
    def name(self) -> str: ...
    @property
    def reason(self) -> str:
        """why it is not estimated, or not determined; else empty"""
    @property
    def status(self) -> str:
        """'estimated', 'fixed' or 'not_estimable'"""
    @property
    def std(self) -> float:
        """standard deviation, with the errors that pairs share"""
    @property
    def std_formal(self) -> float:
        """standard deviation from the noise of points alone (Habib et al. 2011, Eq. 26)"""
    @property
    def unit(self) -> str:
        """of bias, std and std_formal: 'm', 'arcsec' or '1'"""

class PlanResult:
    """What a planned flight will give."""
    @property
    def advice(self) -> list[str]:
        """weak combinations of parameters, why, and which line would help"""
    @property
    def control_points(self) -> int:
        """covered by a line"""
    @property
    def determined(self) -> bool:
        """whether all requested parameters are determined"""
    @property
    def expected(self) -> CalibrationResult:
        """standard deviations, correlations and statuses as of a calibration; biases are
        zero"""
    @property
    def lines(self) -> list[FlightLine]: ...
    def to_dict(self) -> Any:
        """The content of plan.json as dictionaries and lists."""
    def to_frame(self) -> Any:
        """The expected parameters as a pandas.DataFrame; as a dictionary of columns where
        pandas is missing."""

class PointWindow:
    """The part of point files that is read, and how."""
    def __init__(self, **kwargs) -> None: ...
    @property
    def bounds(self) -> Optional[list[float]]:
        """rectangle x_min, y_min, x_max, y_max in the ground frame, m; None: all points"""
    @bounds.setter
    def bounds(self, value: Optional[Iterable[float]]) -> None: ...
    @property
    def channel_field(self) -> str:
        """field with the channel of the scanner: 'user_data' or an extra field"""
    @channel_field.setter
    def channel_field(self, value: str) -> None: ...
    @property
    def columns(self) -> list[str]:
        """columns of .xyz files in their order, 'skip': not used; empty: by the header"""
    @columns.setter
    def columns(self, value: Iterable[str]) -> None: ...
    @property
    def keep_readable(self) -> bool:
        """read what is intact of damaged LAS and LAZ files"""
    @keep_readable.setter
    def keep_readable(self, value: bool) -> None: ...
    @property
    def resolution(self) -> float:
        """distance between points that suffices, m, of COPC files; 0: all points"""
    @resolution.setter
    def resolution(self, value: float) -> None: ...

class Progress:
    """Where a job stands; what progress callbacks are called with, in the thread that called
    the job. A callback that returns False ends the job with Cancelled, one that raises ends it
    with its exception."""
    @property
    def event(self) -> str:
        """'begin', 'advance' or 'end' of a phase, or 'remark'"""
    @property
    def fraction(self) -> float:
        """of the phase, 0 to 1"""
    @property
    def phase(self) -> str:
        """what is done, such as 'Reading the areas'"""
    @property
    def text(self) -> str:
        """of a remark; at the end of a phase what it found ('12 areas')"""

class RadiometricModel:
    """I_c = I (r / r0)^m / cos(theta)^k exp(2 a (r - r0))."""
    def __init__(self, **kwargs) -> None: ...
    @property
    def extinction_per_km(self) -> float:
        """a, one way"""
    @extinction_per_km.setter
    def extinction_per_km(self, value: float) -> None: ...
    def factor(self, range: float, cosine: float) -> float:
        """Corrected over given intensity at a range (m) and cosine of the incidence angle (NaN:
        no incidence term)."""
    @property
    def incidence_exponent(self) -> float:
        """k, 0 to 4"""
    @incidence_exponent.setter
    def incidence_exponent(self, value: float) -> None: ...
    @property
    def largest_incidence(self) -> float:
        """degrees; larger angles are limited to it"""
    @largest_incidence.setter
    def largest_incidence(self, value: float) -> None: ...
    @property
    def range_exponent(self) -> float:
        """m, 0 to 6"""
    @range_exponent.setter
    def range_exponent(self, value: float) -> None: ...
    @property
    def reference_range(self) -> float:
        """r0, m"""
    @reference_range.setter
    def reference_range(self, value: float) -> None: ...

class RoofLine:
    """A straight line of a roof, ground frame."""
    @property
    def covariance(self) -> numpy.ndarray:
        """of the offsets of start to the left and upwards, then of end; m^2"""
    @property
    def end(self) -> numpy.ndarray:
        """m"""
    @property
    def id(self) -> str: ...
    @property
    def kind(self) -> str:
        """'ridge', 'valley', 'eave' or 'unknown'"""
    @property
    def start(self) -> numpy.ndarray:
        """m"""
    @property
    def strips(self) -> list[str]:
        """in which it was seen"""

class RoofLineSettings:
    """Settings of the extraction of roof lines."""
    def __init__(self, **kwargs) -> None: ...
    @property
    def eaves(self) -> bool:
        """also the lower edges of faces"""
    @eaves.setter
    def eaves(self, value: bool) -> None: ...
    @property
    def least_angle(self) -> float:
        """between the faces of a line, rad"""
    @least_angle.setter
    def least_angle(self, value: float) -> None: ...
    @property
    def least_area(self) -> float:
        """of a face, m^2"""
    @least_area.setter
    def least_area(self, value: float) -> None: ...
    @property
    def least_length(self) -> float:
        """m"""
    @least_length.setter
    def least_length(self, value: float) -> None: ...
    @property
    def noise(self) -> float:
        """of points about planes, m; 0: estimated"""
    @noise.setter
    def noise(self, value: float) -> None: ...
    @property
    def threads(self) -> int: ...
    @threads.setter
    def threads(self, value: int) -> None: ...

class SharedErrorModel:
    """Errors that the points of a strip share (standard deviations)."""
    def __init__(self, **kwargs) -> None: ...
    @property
    def correlation_time(self) -> float:
        """s"""
    @correlation_time.setter
    def correlation_time(self, value: float) -> None: ...
    @property
    def heading(self) -> float:
        """rad"""
    @heading.setter
    def heading(self, value: float) -> None: ...
    @property
    def local(self) -> float:
        """remaining errors in an area, m"""
    @local.setter
    def local(self, value: float) -> None: ...
    @property
    def position(self) -> float:
        """of the trajectory, each axis, m"""
    @position.setter
    def position(self, value: float) -> None: ...
    @property
    def roll_pitch(self) -> float:
        """rad"""
    @roll_pitch.setter
    def roll_pitch(self, value: float) -> None: ...

class Simulation:
    """A block of strips with known biases and errors: terrain, houses, trees, flight, scanner,
    noise. Biases are assumed - true."""
    def __init__(self, preset: str = 'small', *, scale: float = 1.0, density: float = 1.0, field_of_view: float = 0.0, height: float = 1.0, noise: str = 'none', scanner: Optional[str] = None, seed: int = 1) -> None:
        """preset: 'paper', 'small', 'uav', 'corridor', 'conical', 'dual', 'rosette',
        'mountain', 'city'; scale: factor on the lengths of the lines; density: factor on the
        pulses per square metre; field_of_view: full angle, rad, 0: of the preset; height:
        factor on the flying heights; noise: 'none', 'range', 'realistic'; scanner:
        'oscillating', 'polygon', 'conical', 'rosette', 'dual', 'cross', 'multi'. UsageError for
        others."""
    def add_errors(self, errors: str) -> None:
        """Adds '[channelN:|sessionN:|stripN:]NAME=VALUE,...' as pcl_als_simulate does."""
    def bias(self, name: str) -> float:
        """Bias of a system parameter, m, arcsec or 1."""
    @property
    def crs(self) -> str: ...
    @crs.setter
    def crs(self, value: str) -> None: ...
    @property
    def origin(self) -> numpy.ndarray:
        """middle of the block, m, ground frame"""
    @origin.setter
    def origin(self, value: ArrayLike) -> None: ...
    def set_bias(self, name: str, value: float) -> None:
        """Sets the bias of a system parameter, m, arcsec or 1."""
    def set_gains(self, gains: str) -> None:
        """Sets 'ID=FACTOR,...': factors on the gain of lines."""
    def set_sessions(self, count: int) -> None:
        """Divides the lines into sessions."""
    @property
    def vertical(self) -> bool:
        """no attitude motion, no crab"""
    @vertical.setter
    def vertical(self, value: bool) -> None: ...

class Strip:
    """One flight line in memory. Points are a structured array of dtype POINT (48 bytes): x, y,
    z in metres relative to origin (float32), gps_time in s, intensity as digital number,
    scan_angle in degrees, point_source_id, return_number, number_of_returns, classification
    (ASPRS code), flags (bits: synthetic, key point, withheld, overlap; scanner channel),
    user_data."""
    def __init__(self, points: ArrayLike, id: str = '1', origin: Optional[ArrayLike] = None, crs: str = '') -> None:
        """A strip of a structured array. An array of empty_points() or of Strip.points, as a
        whole, is used without a copy; any other array is copied by the names of its fields, of
        which x, y and z (metres) are needed; fields that POINT lacks become extra. x, y and z
        are relative to origin. Without an origin, coordinates that are not float32 are those of
        the ground frame, and where they reach further than 4 km the origin is the multiple of
        10 m at the middle of the strip; else it is zero. UsageError for an array without x, y
        and z, and where float32 would round them by more than 1 mm."""
    def __len__(self) -> int: ...
    @property
    def crs(self) -> str:
        """coordinate reference system: WKT or 'EPSG:...'; empty when unknown"""
    @crs.setter
    def crs(self, value: str) -> None: ...
    @property
    def extra(self) -> Mapping[str, numpy.ndarray]:
        """Further fields of the points by name: red, green, blue, nir (16 bits) and extra
        bytes. They are read with read_strips(..., extra=True) and written by write_points().
        New arrays that cannot be written to; to change fields, assign a new mapping."""
    @extra.setter
    def extra(self, value: Mapping[str, ArrayLike]) -> None: ...
    def ground(self) -> numpy.ndarray:
        """Coordinates in the ground frame (easting, northing, height; m): a new array, n x
        3."""
    @property
    def id(self) -> str:
        """name in pairs and results"""
    @id.setter
    def id(self, value: str) -> None: ...
    @property
    def origin(self) -> numpy.ndarray:
        """origin of the coordinates: easting, northing, height in the ground frame, m"""
    @origin.setter
    def origin(self, value: ArrayLike) -> None: ...
    @property
    def points(self) -> numpy.ndarray:
        """The points as an array of dtype POINT on the memory of the strip, without a copy:
        changes of the array change the strip. It stays valid without the strip."""
    def to_frame(self) -> Any:
        """The points, in the ground frame, as a pandas.DataFrame; as a dictionary of columns
        where pandas is missing."""

class StripChoice:
    """Choice of the strips that are used; a list of names does as well."""
    @overload
    def __init__(self, **kwargs) -> None: ...
    @overload
    def __init__(self, only: Iterable[str]) -> None: ...
    @property
    def by_channel(self) -> bool:
        """the channels of the scanner are strips of their own: 3.ch0, 3.ch1"""
    @by_channel.setter
    def by_channel(self, value: bool) -> None: ...
    @property
    def keep_timeless(self) -> bool:
        """keep points of GPS time 0 in files that have times"""
    @keep_timeless.setter
    def keep_timeless(self, value: bool) -> None: ...
    @property
    def only(self) -> list[str]:
        """names of the strips that are used; empty: all"""
    @only.setter
    def only(self, value: Iterable[str]) -> None: ...
    @property
    def split(self) -> bool:
        """cut files without source ids into flight lines at gaps and turns"""
    @split.setter
    def split(self, value: bool) -> None: ...
    @property
    def without(self) -> list[str]:
        """names of strips to exclude"""
    @without.setter
    def without(self, value: Iterable[str]) -> None: ...

class Survey:
    """The points of a survey as strips, from files (.las, .laz, .pcd) that jobs read when they
    need them, in constant memory. One survey serves several jobs, one at a time."""
    def __init__(self, files: Union[_Path, Iterable[_Path]], *, window: PointWindow = ..., threads: int = 0) -> None:
        """Reads all files once (ids, times, extents). threads: 0: all cores; results do not
        depend on it. InputError for a file that cannot be read or does not belong to the
        others."""
    def __len__(self) -> int: ...
    @property
    def crs(self) -> str:
        """common coordinate reference system of the files (WKT or 'EPSG:...'); may be empty"""
    @property
    def extent(self) -> list[float]:
        """x_min, y_min, x_max, y_max of all points, m, ground frame"""
    @property
    def points_by_strip(self) -> dict[str, int]:
        """number of points of each strip"""
    @property
    def remarks(self) -> list[str]:
        """conversions of units, and assumptions"""
    @property
    def strips(self) -> list[str]:
        """names of the strips; after a job those that it used"""
    def to_frame(self) -> Any:
        """The strips as a pandas.DataFrame; as a dictionary of columns where pandas is
        missing."""

class SurveyArea:
    """A square of ground in which strips are compared."""
    @property
    def minimum(self) -> numpy.ndarray:
        """south-west corner, m, ground frame"""
    @property
    def size(self) -> float:
        """side, m"""

class SystemEstimate:
    """One of several systems of a calibration."""
    @property
    def name(self) -> str: ...
    @property
    def offset(self) -> numpy.ndarray:
        """of its coordinates, assumed - true, to the first system: east, north, up, m"""
    @property
    def offset_std(self) -> numpy.ndarray:
        """m"""
    @property
    def parameters(self) -> dict[str, Parameter]: ...
    @property
    def strips(self) -> list[str]: ...

class UsageError(Error, ValueError):
    """A wrong argument or an impossible value; also a ValueError."""

class WaveformResult:
    """The result of a decomposition of waveforms."""
    @property
    def calibration_constant(self) -> Optional[float]:
        """of cross sections; None without a trajectory"""
    @property
    def echoes(self) -> int: ...
    @property
    def new_echoes(self) -> int:
        """that no return belongs to"""
    @property
    def pulse_width_ns(self) -> float:
        """of the response that was used"""
    @property
    def response(self) -> numpy.ndarray:
        """rows of time (ns) and value"""
    def to_dict(self) -> Any:
        """The content of waveform.json of pcl_als_waveform as dictionaries and lists; its entry
        'waveforms' has the samples, echoes and adjusted values of some waveforms."""
    def to_frame(self) -> Any:
        """The echoes of the waveforms in to_dict() as a pandas.DataFrame; as a dictionary of
        columns where pandas is missing."""
    @property
    def warnings(self) -> list[str]: ...
    @property
    def waveforms(self) -> int: ...

class WaveformSettings:
    """Settings of a decomposition; attributes may be given as keywords."""
    def __init__(self, **kwargs) -> None: ...
    @property
    def beam_divergence(self) -> float:
        """full angle, mrad; for cross sections"""
    @beam_divergence.setter
    def beam_divergence(self, value: float) -> None: ...
    @property
    def calibration_constant(self) -> float:
        """of cross sections, m^2 / (count ns km^4); 1: they are relative"""
    @calibration_constant.setter
    def calibration_constant(self, value: float) -> None: ...
    @property
    def correct_attenuation(self) -> bool:
        """divide cross sections by the transmission that the echoes before leave"""
    @correct_attenuation.setter
    def correct_attenuation(self, value: bool) -> None: ...
    @property
    def false_echoes(self) -> float:
        """expected in a waveform"""
    @false_echoes.setter
    def false_echoes(self, value: float) -> None: ...
    @property
    def force(self) -> bool: ...
    @force.setter
    def force(self, value: bool) -> None: ...
    @property
    def gps_week(self) -> Optional[int]: ...
    @gps_week.setter
    def gps_week(self, value: Optional[int]) -> None: ...
    @property
    def move_returns(self) -> bool:
        """to the place of their echo"""
    @move_returns.setter
    def move_returns(self, value: bool) -> None: ...
    @property
    def new_echoes(self) -> bool:
        """write echoes without a return"""
    @new_echoes.setter
    def new_echoes(self, value: bool) -> None: ...
    @property
    def pulse(self) -> list[float]:
        """the response by samples, in place of a Gaussian"""
    @pulse.setter
    def pulse(self, value: Iterable[float]) -> None: ...
    @property
    def pulse_spacing_ns(self) -> float:
        """of these samples"""
    @pulse_spacing_ns.setter
    def pulse_spacing_ns(self, value: float) -> None: ...
    @property
    def pulse_width_ns(self) -> float:
        """full width at half maximum of the response; 0: estimated"""
    @pulse_width_ns.setter
    def pulse_width_ns(self, value: float) -> None: ...
    @property
    def range_from(self) -> str:
        """where times of PulseWaves files count from: 'automatic', 'anchor', 'emitted'"""
    @range_from.setter
    def range_from(self, value: str) -> None: ...
    @property
    def ringing(self) -> float:
        """share of the amplitude of an echo below which echoes behind it are excluded"""
    @ringing.setter
    def ringing(self, value: float) -> None: ...
    @property
    def ringing_reach_ns(self) -> float: ...
    @ringing_reach_ns.setter
    def ringing_reach_ns(self, value: float) -> None: ...
    @property
    def saturation(self) -> float:
        """digitizer counts; 0: the largest that the bits of a sample hold"""
    @saturation.setter
    def saturation(self, value: float) -> None: ...
    @property
    def target_radius(self) -> float:
        """of the points of a target, m"""
    @target_radius.setter
    def target_radius(self, value: float) -> None: ...
    @property
    def threads(self) -> int: ...
    @threads.setter
    def threads(self, value: int) -> None: ...

def calibrate(points: Union[Union[_Path, Iterable[_Path]], Survey, Iterable[Strip]], trajectory: Union[Union[_Path, Iterable[_Path]], Flight], *, control: Union[None, _Path, Iterable[ControlPoint]] = None, settings: CalibrationSettings = ..., strips: Union[StripChoice, Iterable[str]] = ..., pairs: Iterable[tuple[str, str]] = [], references: Iterable[str] = [], gps_week: Optional[int] = None, progress: Optional[Callable[[Progress], Any]] = None) -> CalibrationResult:
    """Estimates boresight angles, lever arm, range bias and scan angle scale from overlapping
    strips (Habib et al. 2011), as pcl_als_calibrate does. points: files, strips in memory or a
    Survey; trajectory: as delivered; control: points or their CSV file; pairs: of strips,
    default all that overlap; references: surfaces as 'FILE[:STD[:OFFSET]]', m; gps_week: of
    times in seconds of the week. Whether the result may be applied is its verdict. InputError
    for data that cannot be used."""

def check(points: Union[Union[_Path, Iterable[_Path]], Survey, Iterable[Strip]], *, before: Union[None, Union[_Path, Iterable[_Path]], Survey, Iterable[Strip]] = None, control: Union[None, _Path, Iterable[ControlPoint]] = None, trajectory: Union[None, Union[_Path, Iterable[_Path]], Flight] = None, quality_level: int = 2, settings: CheckSettings = ..., strips: Union[StripChoice, Iterable[str]] = ..., progress: Optional[Callable[[Progress], Any]] = None) -> CheckResult:
    """Measures how well overlapping strips agree with each other and with control, as
    pcl_als_check does. before: the same strips before a correction, compared in the same areas;
    quality_level: of the USGS Lidar Base Specification that is required, 0 to 3; trajectory:
    for scan angles that are finer than those of the files. Whether there is a reliable answer
    is told by the result. InputError for data that cannot be used."""

def classify(files: Union[_Path, Iterable[_Path]], output: _Path, *, training: Optional[_Path] = None, model: Optional[ClassModel] = None, checkpoints: Optional[_Path] = None, cell: float = 1.0, bands: Optional[Iterable[str]] = None, grids: Optional[_Path] = None, posterior: Optional[_Path] = None, points: Optional[_Path] = None, reject: float = 0.0, training_radius: float = 0.0, strips: Union[StripChoice, Iterable[str]] = ..., threads: int = 0, progress: Optional[Callable[[Progress], Any]] = None) -> LandCover:
    """Maps the land cover of point files by Gaussian maximum likelihood, as pcl_als_classify
    does. output: GeoTIFF of classes, an empty path: rasters only; training: CSV or GeoJSON of
    sites, or model; checkpoints: sites for the accuracy; cell: m; bands: names of the rasters
    that separate the classes; grids, posterior: GeoTIFFs to write; points: folder for point
    files with classes; reject: probability below which a cell has no class; training_radius: m.
    UsageError for impossible options, InputError for input that cannot be used."""

def convert(inputs: Union[_Path, Iterable[_Path]], output: _Path, *, window: PointWindow = ..., strips: Union[StripChoice, Iterable[str]] = ..., format: str = '', keep_ids: bool = False, number_lines: bool = False, las_version: str = '', time_offset: Optional[int] = None, threads: int = 0, progress: Optional[Callable[[Progress], Any]] = None) -> list[ConvertedFile]:
    """Converts point files (.las, .laz, .pcd, .ply, .xyz) into each other, or writes parts of
    them; the bytes of LAS records stay as they are. output: a file for one input, else a
    folder, whose files have the given format ('las', 'laz', 'pcd', 'ply', 'xyz'; default: that
    of the input). With strips.split one file for each strip, whose lines get point source ids
    of their own unless keep_ids is set. number_lines: the files as they are, with the number of
    its line as the point source id of each point (0 between lines). las_version: '1.4' or
    '1.5', of whole files; time_offset: of LAS 1.5, millions of seconds that are subtracted from
    GPS time. UsageError for number_lines or las_version with a choice of strips. Constant
    memory."""

def convert_trajectory(paths: Union[_Path, Iterable[_Path]], output: _Path, *, calibration: Optional[Union[_Path, CalibrationResult]] = None, crs: str = '', strip_corrections: bool = True, force: bool = False, progress: Optional[Callable[[Progress], Any]] = None) -> list[pathlib.Path]:
    """Reads trajectory files, takes lever arm and strip corrections of a calibration out, and
    writes one trajectory: .csv, or .sbet or .out with a crs. Returns the files."""

def correct_file(input: _Path, output: _Path, trajectory: Union[Union[_Path, Iterable[_Path]], Flight], calibration: Union[_Path, CalibrationResult], *, strip_corrections: bool = False, invert: bool = False, keep_uncovered: bool = False, force: bool = False, gps_week: Optional[int] = None, threads: int = 0, progress: Optional[Callable[[Progress], Any]] = None) -> FileCorrection:
    """Removes the biases of a calibration from a point file (Habib et al. 2011, Eq. 13), as
    pcl_als_apply does: .las and .laz in constant memory with every other byte kept, .pcd.
    strip_corrections: also the errors of the trajectory that were estimated; invert: applies
    the biases instead; keep_uncovered: any number of points without trajectory stay unchanged,
    else at most 1 %; force: continue where the verdict or the trajectory is against it.
    UsageError for a calibration that should not be applied."""

def correct_intensity(inputs: Union[_Path, Iterable[_Path]], outputs: Union[_Path, Iterable[_Path]], trajectory: Union[Union[_Path, Iterable[_Path]], Flight], *, settings: IntensitySettings = ..., atmosphere: Optional[Atmosphere] = None, output: IntensityOutput = ..., targets: Optional[_Path] = None, target_radius: float = 1.0, progress: Optional[Callable[[Progress], Any]] = None) -> IntensityResult:
    """Corrects intensities of point files for range, incidence and atmosphere (radar equation;
    Habib et al. 2011, Eq. 35-36), as pcl_als_intensity does; one output for each input.
    atmosphere: sets the extinction of the model; targets: CSV of places of known reflectance,
    used within target_radius (m). InputError where points have no trajectory."""

def correct_strip(strip: Strip, trajectory: Union[Union[_Path, Iterable[_Path]], Flight], calibration: Union[_Path, CalibrationResult], *, strip_corrections: bool = False, invert: bool = False, keep_uncovered: bool = False, threads: int = 0) -> Strip:
    """The same of a strip in memory; returns a new Strip."""

def decompose_waveforms(input: _Path, output: _Path, *, settings: WaveformSettings = ..., waveforms: Iterable[int] = [], trajectory: Union[None, Union[_Path, Iterable[_Path]], Flight] = None, atmosphere: Optional[Atmosphere] = None, targets: Optional[_Path] = None, progress: Optional[Callable[[Progress], Any]] = None) -> WaveformResult:
    """Decomposes the waveforms of a LAS, LAZ or PulseWaves file into echoes and writes them as
    points, as pcl_als_waveform does. waveforms: numbers of points (or pulses) whose waveforms
    the result contains, from 0, in place of examples; trajectory: for cross sections, with the
    extinction of an atmosphere, calibrated by targets (CSV of places of known reflectance).
    InputError for files without waveforms and damaged ones."""

def empty_points(count: int) -> numpy.ndarray:
    """An array of that many points of dtype POINT, all at the origin, to be filled. A Strip
    takes it as it is, without a copy."""

def extract_lines(files: Union[_Path, Iterable[_Path]], *, settings: RoofLineSettings = ..., strips: Union[StripChoice, Iterable[str]] = ..., output: Optional[_Path] = None, progress: Optional[Callable[[Progress], Any]] = None) -> list[RoofLine]:
    """Finds roof lines in the strips of files and combines them, as pcl_als_lines does. output:
    .csv or .geojson to write as well."""

def icpatch(source: Union[_Path, Strip], target: Union[_Path, Strip], *, settings: AlignmentSettings = ..., progress: Optional[Callable[[Progress], Any]] = None) -> Alignment:
    """The rigid motion of one strip onto another, by ICPatch (Habib et al. 2011, section 2.3),
    as pcl_als_icpatch does. Both are strips in memory, or both files."""

def local_origin(ground: ArrayLike) -> numpy.ndarray:
    """An origin for the floats of a Strip around a ground point (m): multiples of 10 m, which
    PCD files keep exactly."""

def move_file(input: _Path, output: _Path, motion: Alignment, *, threads: int = 0) -> int:
    """Writes a copy of a point file with moved points, everything else byte for byte; returns
    the number of points."""

def orient(images: _Path, lines: _Path, camera: _Path, *, measurements: Optional[_Path] = None, checkpoints: Optional[_Path] = None, assign_distance: float = 0.0, image_sigma: float = 0.5, progress: Optional[Callable[[Progress], Any]] = None) -> Orientation:
    """Orients an image block by a bundle adjustment with roof lines as control, as
    pcl_als_orient does; measurements: default measurements.csv beside the images;
    assign_distance: lines of other names are assigned by position up to this distance, m;
    image_sigma: standard deviation of image coordinates without one, their unit."""

def plan(lines: Union[_Path, Iterable[FlightLine]], *, control: int = 0, settings: CalibrationSettings = ...) -> PlanResult:
    """Predicts the standard deviations of the parameters from a planned calibration flight, as
    pcl_als_plan does. lines: FlightLines, or a CSV id,x1,y1,x2,y2,height[,speed][,density];
    control: number of control points, distributed over the block; settings: estimate, noise,
    shared_errors, control_sigma and threads are used. InputError where no two lines overlap."""

def read_calibration(path: _Path) -> CalibrationResult:
    """Reads a calibration.json. InputError for a file that is none."""

def read_class_model(path: _Path) -> ClassModel:
    """Reads a model that was written. InputError names the file and what is wrong with it."""

def read_control(path: _Path) -> list[ControlPoint]:
    """Reads control points from CSV with columns id, x, y, z and optionally sigma, m."""

def read_strips(files: Union[_Path, Iterable[_Path]], *, extra: Union[bool, Iterable[str]] = False, bounds: Optional[Iterable[float]] = None, window: PointWindow = ...) -> list[Strip]:
    """Reads .las, .laz, .pcd, .ply and .xyz files whole, as strips: 48 bytes a point. A strip
    that reaches further than 4 km from its centre comes in parts of the same id. extra: True or
    names, for colours (red, green, blue, nir) and extra bytes of LAS files as Strip.extra;
    bounds: x_min, y_min, x_max, y_max in the ground frame, m, of the points that are read;
    window: more of that kind. InputError for files that cannot be read or that do not belong
    together."""

def read_trajectory(paths: Union[_Path, Iterable[_Path]], *, crs: str = '', own_crs: str = '', attitude: str = 'where_given', columns: Iterable[str] = [], leap_seconds: Optional[float] = None, geoid: str = '', axes: str = 'by_course') -> Flight:
    """Reads a trajectory from a file, several files or a folder: text with named columns, SBET,
    TerraScan .trj, RIEGL .pof, Leica .sol. crs: of the points, needed for geographic and
    geocentric coordinates; own_crs: of the files; attitude: 'where_given', 'needed', 'ignore'
    or 'nominal' (level, heading along the course); columns: names of the columns of text files;
    leap_seconds: added to times in UTC, s; geoid: undulation in m or path of a grid; axes:
    'ned' (roll right wing down, pitch nose up, heading clockwise from north), 'enu' (pitch nose
    down, yaw counter-clockwise from east), or 'by_course': ned, of a yaw and of quaternions as
    the course shows. InputError names the file and line."""

def reconstruct_trajectory(points: Union[Union[_Path, Iterable[_Path]], Survey, Iterable[Strip]], *, output: Optional[_Path] = None, attitude: bool = False, strips: Union[StripChoice, Iterable[str]] = ..., threads: int = 0, progress: Optional[Callable[[Progress], Any]] = None) -> Flight:
    """Reconstructs the trajectory from the points, as pcl_als_trajectory does: from rays
    through several returns of a pulse and from scan angles. output: .csv or .sbet to write as
    well, with standard deviations; attitude: reads the points again for pitch and heading.
    Warnings, and why it is not complete, are remarks of the result. InputError where no path is
    determined."""

def simulate(folder: _Path, simulation: Simulation, *, compressed: bool = False, adjusted_time: bool = False, truth_points: bool = False, images: bool = False, threads: int = 0, progress: Optional[Callable[[Progress], Any]] = None) -> None:
    """Simulates a block into a folder: strip1.las ... (.laz where compressed), trajectory.csv,
    control.csv, training.csv, checkpoints.csv, truth.json, as pcl_als_simulate does.
    truth_points: extra bytes with the effect of the biases. Equal options give equal points."""

def write_pcd(path: _Path, strip: Strip) -> None:
    """Writes a strip as a binary PCD with every field; the file appears when it is complete.
    UsageError for another extension than .pcd."""

def write_points(path: _Path, strips: Union[Iterable[Strip], Strip]) -> None:
    """Writes a strip, or several, into one file by its extension: .las and .laz (version 1.4;
    point format 6, with colours 7, with near infrared 8; steps of 1 mm; Strip.extra as colours
    and extra bytes; CRS; times below two weeks as seconds of the week), or .pcd (one strip).
    Where points have no point_source_id, a number as id of the strip is written as theirs. The
    file appears when it is complete. UsageError for another extension and for strips that could
    not be told apart."""
