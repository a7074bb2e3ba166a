using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Films;
using FractalEngine.Core.Views;

namespace FractalEngine.Render.Cameras;

/// <summary>
/// A camera that passes through others at given times: positions on a Catmull-Rom spline, orientations and angles of view in between.
/// </summary>
/// <remarks>
/// Where two keys after each other look at the same point, the camera looks at it all the way: its direction from there lies on the
/// spline, and so does the logarithm of its distance. At an even pace each second then brings it closer by the same factor. No key has a
/// jump of velocity, unless its ease asks for that.
/// </remarks>
public sealed class CameraPath
{
    private readonly CameraKey[] _keys;
    private readonly Camera[] _cameras;

    // World space, scene units a second, at each key; and those of the points that are looked at.
    private readonly Vector[] _velocities;
    private readonly Vector[] _targetVelocities;
    private readonly Handedness _handedness;
    private readonly bool _isFilm;

    /// <summary>Makes a path through cameras, one a second, which begins and ends at half its pace.</summary>
    /// <param name="cameras">At least two, with coordinates up to <see cref="CameraKey.MaxCoordinate"/>.</param>
    /// <param name="handedness">That of the scene.</param>
    /// <exception cref="ArgumentOutOfRangeException">There are fewer than two cameras.</exception>
    public CameraPath(IEnumerable<Camera> cameras, Handedness handedness)
        : this([.. cameras.Select(static (camera, index) => new CameraKey(index, camera))], handedness, false) =>
        ArgumentOutOfRangeException.ThrowIfLessThan(_keys.Length, 2, nameof(cameras));

    /// <summary>Makes the path of a film. Each key has its own camera, to the bit.</summary>
    /// <param name="keys">
    /// At least one, each later than the one before, with coordinates up to <see cref="CameraKey.MaxCoordinate"/>.
    /// </param>
    /// <param name="handedness">That of the scene.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no key.</exception>
    public CameraPath(IEnumerable<CameraKey> keys, Handedness handedness)
        : this([.. keys], handedness, true) => ArgumentOutOfRangeException.ThrowIfZero(_keys.Length, nameof(keys));

    private CameraPath(CameraKey[] keys, Handedness handedness, bool isFilm)
    {
        (_keys, _handedness, _isFilm) = (keys, handedness, isFilm);
        _cameras = [.. keys.Select(CreateCamera)];
        _velocities = [.. keys.Select((_, index) => VelocityAt(index))];
        _targetVelocities = [.. keys.Select((_, index) => PivotAt(index) is not null || keys[index].Target is null ? Vector.Zero
            : SlopeAt(index, static (_, _) => true, near => keys[near].Target?.Point ?? keys[index].Target!.Value.Point))];
    }

    /// <summary>Time of the last key, seconds.</summary>
    public double Duration => _keys[^1].Time;

    /// <summary>Returns the camera at a time.</summary>
    /// <param name="time">Seconds; the first key counts before its time, the last one after it.</param>
    public Camera At(double time)
    {
        if (_keys.Length == 1)
        {
            return _cameras[0];
        }

        var index = Math.Clamp(Array.FindLastIndex(_keys, key => key.Time <= time), 0, _keys.Length - 2);
        var fraction = _keys[index + 1].ProgressAt(_keys[index].Time, time);
        var (from, to) = (_cameras[index], _cameras[index + 1]);
        if (_isFilm && fraction is 0 or 1)
        {
            return fraction == 0 ? from : to;
        }

        var (position, forward, up) = MoveBetween(index, new(fraction));
        // Two opposite directions have no middle; the turn then happens at once.
        var direction = forward.Length() > 1e-6 ? forward : from.LocalAxes.V3;
        var fieldOfView = from.FieldOfView + (fraction * (to.FieldOfView - from.FieldOfView));
        // Far away, a point before the camera would be the camera's own.
        return CameraFraming.LookAt(Vector.Zero, direction, up.Length() > 1e-6 ? up : from.LocalAxes.V2, fieldOfView, _handedness) with
        {
            Position = position,
            Aperture = from.Aperture + (fraction * (to.Aperture - from.Aperture)),
            FocusDepth = from.FocusDepth + (fraction * (to.FocusDepth - from.FocusDepth)),
        };
    }

    private (Vector Position, Vector Forward, Vector Up) MoveBetween(int index, Hermite spline)
    {
        var (from, to) = (_cameras[index], _cameras[index + 1]);
        var duration = _keys[index + 1].Time - _keys[index].Time;
        var (startSlope, endSlope) = (duration * _velocities[index], duration * _velocities[index + 1]);
        if (_keys[index].Target is not var (point, up) || _keys[index + 1].Target is not var (nextPoint, nextUp))
        {
            return (spline.Between(from.Position, startSlope, to.Position, endSlope),
                spline.Mix(from.LocalAxes.V3, to.LocalAxes.V3), spline.Mix(from.LocalAxes.V2, to.LocalAxes.V2));
        }

        var mixedUp = spline.Mix(up.UnitVector(), nextUp.UnitVector());
        if (point != nextPoint)
        {
            var position = spline.Between(from.Position, startSlope, to.Position, endSlope);
            var target = spline.Between(
                point, duration * _targetVelocities[index], nextPoint, duration * _targetVelocities[index + 1]);
            return (position, target == position ? Vector.Zero : (target - position).UnitVector(), mixedUp);
        }

        var (start, end) = (new Polar(from.Position - point), new Polar(to.Position - point));
        var (startTurn, startGrowth) = start.Split(startSlope);
        var (endTurn, endGrowth) = end.Split(endSlope);
        var direction = spline.Between(start.Direction, startTurn, end.Direction, endTurn);
        direction = direction.Length() > 1e-6 ? direction.UnitVector() : start.Direction;
        var distance = Math.Exp(spline.Between(start.LogDistance, startGrowth, end.LogDistance, endGrowth).X);
        return (point + (distance * direction), -direction, mixedUp);
    }

    private Camera CreateCamera(CameraKey key) => key.Target is var (point, up)
        ? CameraFraming.LookAt(key.Camera.Position, point, up, key.Camera.FieldOfView, _handedness) with
        {
            Aperture = key.Camera.Aperture,
            FocusDepth = key.Camera.FocusDepth,
        }
        : key.Camera with { Handedness = _handedness };

    private bool SharePivot(int index, int next) => _keys[index].Target is var (point, _) && point == _keys[next].Target?.Point;

    /// <summary>The point that a key and one beside it look at; null where they look at different ones.</summary>
    private Vector? PivotAt(int index) =>
        (index > 0 && SharePivot(index - 1, index)) || (index + 1 < _keys.Length && SharePivot(index, index + 1))
            ? _keys[index].Target!.Value.Point : null;

    private Vector VelocityAt(int index)
    {
        if (PivotAt(index) is not { } pivot)
        {
            return SlopeAt(index, static (_, _) => true, near => _cameras[near].Position);
        }

        Polar PolarAt(int near) => new(_cameras[near].Position - pivot);
        var turn = SlopeAt(index, SharePivot, near => PolarAt(near).Direction);
        var growth = SlopeAt(index, SharePivot, near => PolarAt(near).LogDistance).X;
        return PolarAt(index).Join(turn, growth);
    }

    /// <summary>Returns the change of a quantity a second at a key: that from the key before to the one behind.</summary>
    private Vector SlopeAt(int index, Func<int, int, bool> belongTogether, Func<int, Vector> quantity)
    {
        // What is held jumps, so that there is no way from the one to the other.
        var before = index > 0 && _keys[index].Ease != Ease.Hold && belongTogether(index - 1, index) ? index - 1 : index;
        var isFollowed = index + 1 < _keys.Length && _keys[index + 1].Ease != Ease.Hold && belongTogether(index, index + 1);
        var after = isFollowed ? index + 1 : index;
        if (before == after)
        {
            return Vector.Zero;
        }

        var slope = (quantity(after) - quantity(before)) / (_keys[after].Time - _keys[before].Time);
        return _isFilm || after - before > 1 ? slope : 0.5 * slope;
    }

    /// <summary>A direction from a pivot and the logarithm of the distance, with their changes.</summary>
    private readonly struct Polar(Vector offset)
    {
        private readonly double _distance = offset.Length();

        public Vector Direction => offset.UnitVector();

        /// <summary>The logarithm of the distance as x, since splines are of vectors.</summary>
        public Vector LogDistance => new(Math.Log(_distance), 0, 0);

        /// <summary>Returns the change of the offset.</summary>
        public Vector Join(Vector turn, double growth) => _distance * ((growth * Direction) + turn);

        /// <summary>Returns the changes of the direction and of the logarithm.</summary>
        public (Vector Turn, Vector Growth) Split(Vector velocity)
        {
            var relative = velocity / _distance;
            var growth = Vector.Dot(relative, Direction);
            return (relative - (growth * Direction), new(growth, 0, 0));
        }
    }

    /// <summary>Weights of a cubic Hermite spline, and those of a straight line, at a fraction of the way.</summary>
    private readonly struct Hermite(double t)
    {
        private readonly double _t2 = t * t;
        private readonly double _t3 = t * t * t;

        public Vector Mix(Vector from, Vector to) => ((1 - t) * from) + (t * to);

        public Vector Between(Vector from, Vector startSlope, Vector to, Vector endSlope) =>
            (((2 * _t3) - (3 * _t2) + 1) * from) + ((_t3 - (2 * _t2) + t) * startSlope)
            + (((3 * _t2) - (2 * _t3)) * to) + ((_t3 - _t2) * endSlope);
    }
}
