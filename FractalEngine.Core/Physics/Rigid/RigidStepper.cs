using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Events;
using FractalEngine.Core.Physics.Islands;
using FractalEngine.Core.Physics.Statics;
using FractalEngine.Core.Threading;

namespace FractalEngine.Core.Physics.Rigid;

/// <summary>
/// Takes the bodies of a world through a step in which bodies have the shape of their meshes: gathers what may meet, finds the contacts,
/// solves them, moves everything until it touches, and puts to sleep what rests.
/// </summary>
internal sealed class RigidStepper
{
    // Radians that a body turns in a substep at most.
    private const double MaxAngle = 0.5;

    // Substeps of a step, and at most so many where bodies turn fast.
    private const int MinSubsteps = 8;
    private const int MaxSubsteps = 1024;

    // How often contacts are looked for anew in a step where something has been stopped that none of them held.
    private const int MaxSearches = 4;

    // Relative to the radius of the smaller body: the gap at which surfaces rest on each other.
    private const double ContactDistance = 1e-4;

    // Relative to the largest coordinate: the gap must be told from rounding.
    private const double MinContactDistance = 1e-11;

    // Relative to the radius of the smaller body: the largest gap at which a contact is known before it is touched.
    private const double MaxMargin = 0.02;

    // What makes a smaller part of its way counts as held, and after so many substeps it is slowed down.
    private const double MinFraction = 0.01;
    private const int MaxHeldCount = 8;

    // Sweeps of what goes on where others have been stopped.
    private const int MaxSweepRounds = 40;

    // Relative to the contact distance: no closer does a sweep let surfaces come.
    private const double SweepDistance = 0.25;

    private readonly List<Body> _bodies;
    private readonly StaticObjectSet _statics;
    private readonly PhysicsSettings _settings;
    private readonly ContactLog _log;
    private readonly int _maxThreads;
    private readonly Dictionary<object, RigidShape> _shapes = [];
    private readonly List<RigidSurface> _surfaces = [];
    private readonly List<RigidPair> _pairs = [];
    private readonly List<RigidRow> _rows = [];
    private readonly List<int> _order = [];
    private readonly ContactCache _cache = new();
    private readonly DisjointSets _islands = new();
    private readonly (ContactSearch Contacts, PairSweep Sweep)[] _searches;
    private readonly List<List<ContactPoint>> _contacts = [];
    private readonly List<List<NearPair>> _near = [];
    private readonly List<double> _margins = [];
    private readonly List<double> _ways = [];
    private readonly List<double> _impacts = [];
    private RigidState[] _states = [];
    private Vector _gravity;
    private double _stepSeconds;
    private double _seconds;
    private double _fraction;
    private int _round;
    private Action<RigidStepper, int, int>? _act;

    public RigidStepper(PhysicsSettings settings, List<Body> bodies, StaticObjectSet statics, ContactLog log, int maxThreads)
    {
        _settings = settings;
        _bodies = bodies;
        _statics = statics;
        _log = log;
        _maxThreads = maxThreads;
        _searches = [.. Enumerable.Range(0, maxThreads).Select(static _ => (new ContactSearch(), new PairSweep()))];
    }

    /// <summary>True where a body of the world has the shape of its mesh, so that this takes all bodies through their steps.</summary>
    public bool IsNeeded { get; private set; }

    /// <summary>Finds out whether a body has the shape of its mesh.</summary>
    public void PlaceBodies() => IsNeeded = _bodies.Exists(static body => body.Description.Mesh is not null);

    /// <summary>Forgets the contacts of all steps so far.</summary>
    public void Reset() => _cache.Clear();

    /// <summary>Counts the tests of all searches so far.</summary>
    public (long Faces, long Bounds) CountTests()
    {
        var (faces, bounds) = (0L, 0L);
        foreach (var (contacts, sweep) in _searches)
        {
            faces += contacts.FaceTests + sweep.FaceTests;
            bounds += contacts.BoundTests + sweep.BoundTests;
        }

        return (faces, bounds);
    }

    /// <summary>Takes all bodies through a step, or one of the parts in which objects move.</summary>
    /// <param name="gravity">Units per second².</param>
    /// <param name="seconds">Length of the part.</param>
    public void StepPart(Vector gravity, double seconds)
    {
        _gravity = gravity;
        _stepSeconds = seconds;
        GatherSurfaces();
        WakeNearMoving();
        var angle = 0.0;
        foreach (var body in _bodies)
        {
            if (!body.IsAsleep)
            {
                body.Shrink(seconds);
            }

            angle = Math.Max(angle, body.IsAsleep ? 0 : body.AngularVelocity.Length() * seconds);
        }

        var left = (int)Math.Clamp(Math.Ceiling(angle / MaxAngle), MinSubsteps, MaxSubsteps);
        var substep = seconds / left;
        for (var searches = 1; left > 0; searches++)
        {
            _seconds = left * substep;
            BeginPart(seconds - _seconds);
            var count = _pairs.Count == 0 && angle <= MaxAngle ? 1 : left;
            left = MoveSubsteps(count, canStop: searches < MaxSearches);
            StoreContacts();
        }

        Sleep(seconds);
    }

    /// <summary>Lists all bodies, then all objects that stop something.</summary>
    private void GatherSurfaces()
    {
        var count = _bodies.Count + _statics.Objects.Count;
        for (var i = 0; i < count; i++)
        {
            var body = i < _bodies.Count ? _bodies[i] : null;
            var target = i < _bodies.Count ? null : _statics.Objects[i - _bodies.Count];
            var isKnown = i < _surfaces.Count && ReferenceEquals(_surfaces[i].Body, body) && ReferenceEquals(_surfaces[i].Target, target);
            if (!isKnown)
            {
                _surfaces.RemoveRange(Math.Min(i, _surfaces.Count), Math.Max(0, _surfaces.Count - i));
                _surfaces.Add(body is not null ? new(body, ShapeOf(body)) : new(target!, ShapeOf(target!)));
            }
            else if (target is not null)
            {
                _surfaces[i].Shape = ShapeOf(target);
            }
        }

        _surfaces.RemoveRange(count, _surfaces.Count - count);
        foreach (var surface in _surfaces)
        {
            surface.Shape.Trim();
        }

        if (_states.Length < count)
        {
            _states = new RigidState[2 * count];
            _islands.Reserve(2 * count);
        }
    }

    private RigidShape ShapeOf(Body body) => body.Description switch
    {
        { Mesh: { } mesh } => ShapeOf((mesh.Model, mesh.Linear), mesh, static mesh => RigidShape.Of(mesh)),
        { Shape: { } compound } => ShapeOf(compound, compound, static compound => RigidShape.Of(compound)),
        _ => ShapeOf(typeof(Body), 0, static _ => RigidShape.CreateBall()),
    };

    private RigidShape ShapeOf(StaticObject target) =>
        ShapeOf((target.Model, target.Reference.ObjectToWorld.Linear, true), target, static target => RigidShape.Of(target));

    private RigidShape ShapeOf<TKey, TSource>(TKey key, TSource source, Func<TSource, RigidShape> create)
        where TKey : notnull
    {
        if (!_shapes.TryGetValue(key, out var shape))
        {
            shape = create(source);
            shape.Reserve(_maxThreads);
            _shapes[key] = shape;
        }

        return shape;
    }

    /// <summary>Finds the contacts of all that may meet in the rest of the step.</summary>
    private void BeginPart(double elapsed)
    {
        SetMotions(elapsed);
        FindPairs();
        RunOnPairs(static (stepper, pair, thread) => stepper.FindContacts(pair, thread));
        AddRows();
    }

    /// <summary>Makes substeps until the part ends.</summary>
    /// <param name="count">Their number, which fill the part.</param>
    /// <param name="canStop">True to end the part where something has been stopped that no contact held.</param>
    /// <returns>The number of those that are left.</returns>
    private int MoveSubsteps(int count, bool canStop)
    {
        _fraction = 1.0 / count;
        for (var i = 0; i < count; i++)
        {
            for (var k = 0; k < _surfaces.Count; k++)
            {
                _states[k].BeginSubstep();
            }

            RigidSolver.Solve(
                _states.AsSpan(0, _surfaces.Count), CollectionsMarshal.AsSpan(_rows), _fraction * _seconds);
            SetPlannedMotions(i * _fraction);
            Sweep();
            if (Commit() && canStop)
            {
                return count - 1 - i;
            }
        }

        return 0;
    }

    /// <summary>Begins a part: all states, and where everything may get to without contacts.</summary>
    private void SetMotions(double elapsed)
    {
        for (var i = 0; i < _surfaces.Count; i++)
        {
            var surface = _surfaces[i];
            _states[i] = surface.Body is { } body ? CreateState(body) : CreateState(surface, elapsed);
            ref readonly var state = ref _states[i];
            if (surface.Body is not null)
            {
                surface.SetReach((_seconds * state.Velocity) + (_seconds * _seconds * state.Acceleration), _seconds * state.Spin);
            }
        }
    }

    private RigidState CreateState(Body body)
    {
        var state = new RigidState { Turn = Orientation.Identity, Orientation = body.Orientation };
        if (body.IsAsleep)
        {
            return state;
        }

        var mass = body.Description.Mass;
        state.Velocity = body.Velocity;
        state.Spin = body.AngularVelocity;
        state.Acceleration = _gravity + ((body.Force + body.StepForce) / mass);
        state.Torque = body.StepTorque;
        state.InverseMass = 1 / mass;
        state.Damping = body.Description.Damping;
        state.LocalInertia = body.Inertia is { } inertia ? mass * body.Scale * body.Scale * inertia
            : body.InverseInertia > 0 ? (1 / body.InverseInertia) * Matrix.Identity : default;
        state.LocalInverseInertia = body.Description.IsRotationLocked ? default : state.LocalInertia.Inverse();
        state.UpdateInertia();
        return state;
    }

    private RigidState CreateState(RigidSurface surface, double elapsed)
    {
        var target = surface.Target!;
        var state = new RigidState { Turn = Orientation.Identity, Orientation = Orientation.Identity };
        if (target.Kinematic is not { } moved)
        {
            surface.PartMotion = new(target.ObjectToWorld.Translation, Orientation.Identity, 1, Vector.Zero, Vector.Zero);
            surface.Motion = surface.PartMotion;
            surface.SweptBounds = target.Bounds;
            return state;
        }

        state.Velocity = moved.Velocity;
        state.Spin = moved.AngularVelocity;
        state.Orientation = moved.Pose.Orientation.TurnedBy(elapsed * moved.AngularVelocity);
        surface.PartMotion = new(
            moved.Pose.Position + (elapsed * moved.Velocity), state.Orientation, 1, _seconds * moved.Velocity,
            _seconds * moved.AngularVelocity);
        surface.Motion = surface.PartMotion;
        surface.SweptBounds = moved.SweptBounds;
        return state;
    }

    /// <summary>Finds the pairs whose boxes meet: a body that is awake with other bodies and objects.</summary>
    private void FindPairs()
    {
        _pairs.Clear();
        _order.Clear();
        for (var i = 0; i < _bodies.Count; i++)
        {
            _order.Add(i);
        }

        _order.Sort((i, j) => _surfaces[i].SweptBounds.Minimum.X.CompareTo(_surfaces[j].SweptBounds.Minimum.X) is var order and not 0
            ? order : i.CompareTo(j));
        for (var place = 0; place < _order.Count; place++)
        {
            var surface = _surfaces[_order[place]];
            for (var next = place + 1; next < _order.Count; next++)
            {
                var other = _surfaces[_order[next]];
                if (other.SweptBounds.Minimum.X - (MaxMargin * surface.Radius) > surface.SweptBounds.Maximum.X)
                {
                    break;
                }

                AddPair(Math.Min(_order[place], _order[next]), Math.Max(_order[place], _order[next]));
            }

            for (var target = _bodies.Count; target < _surfaces.Count; target++)
            {
                AddPair(_order[place], target);
            }
        }

        _pairs.Sort(static (pair1, pair2) => pair1.Key.CompareTo(pair2.Key));
        while (_contacts.Count < _pairs.Count)
        {
            _contacts.Add([]);
            _near.Add([]);
            _margins.Add(0);
            _ways.Add(0);
            _impacts.Add(1);
        }
    }

    private void AddPair(int first, int second)
    {
        var (surface, other) = (_surfaces[first], _surfaces[second]);
        var body = surface.Body!;
        var canMeet = other.Body is { } otherBody
            ? Layers.CanMeet(body.Description.Layer, body.Description.Mask, otherBody.Description.Layer, otherBody.Description.Mask)
            : StaticObjectSet.CanMeet(other.Target!, body.Description.Layer, body.Description.Mask);
        var radius = Math.Min(surface.Radius, other.Body?.Radius ?? double.PositiveInfinity);
        var gap = Vector.Max(
            other.SweptBounds.Minimum - surface.SweptBounds.Maximum, surface.SweptBounds.Minimum - other.SweptBounds.Maximum);
        if (canMeet && (surface.IsAwake || other.IsAwake) && !other.SweptBounds.IsEmpty
            && Math.Max(gap.X, Math.Max(gap.Y, gap.Z)) <= MaxMargin * radius)
        {
            var distance = Math.Max(ContactDistance * radius, MinContactDistance * body.Position.MaxAbsComponent());
            _pairs.Add(new(first, second, distance));
        }
    }

    private void RunOnPairs(Action<RigidStepper, int, int> act)
    {
        _act = act;
        WorkerSet.Shared.Run(_maxThreads, _maxThreads, this, static (stepper, thread) =>
        {
            for (var pair = thread; pair < stepper._pairs.Count; pair += stepper._maxThreads)
            {
                stepper._act!(stepper, pair, thread);
            }
        });
    }

    private void FindContacts(int index, int thread)
    {
        var pair = _pairs[index];
        var (first, second) = (_surfaces[pair.First], _surfaces[pair.Second]);
        _contacts[index].Clear();
        var origin = first.Motion.Origin;
        var motion1 = first.Motion.RelativeTo(origin);
        var motion2 = second.Motion.RelativeTo(origin);
        var radius = Math.Min(first.Radius, second.Body?.Radius ?? double.PositiveInfinity);
        var margin = (2 * pair.Distance) + Math.Min(MaxWay(first, in motion1, second, in motion2), MaxMargin * radius);
        _near[index].Clear();
        _ways[index] = 0;
        var isAll = _searches[thread].Contacts.FindContacts(
            first.Shape.NodesOf(thread), in motion1, second.Shape.NodesOf(thread), in motion2, pair.Distance, margin, _contacts[index],
            _near[index]);
        _margins[index] = isAll ? margin : 0;
    }

    /// <summary>How far points of two surfaces may come closer in a unit of time at most.</summary>
    private static double MaxWay(RigidSurface first, in SurfaceMotion motion1, RigidSurface second, in SurfaceMotion motion2)
    {
        var way = (motion1.Travel - motion2.Travel).Length() + (motion1.Angle * (first.Radius + motion1.Arm.Length()));
        var radius = second.Body?.Radius ?? first.Radius + (motion2.Origin - motion1.Origin).Length();
        return way + (motion2.Angle * (radius + motion2.Arm.Length()));
    }

    private void AddRows()
    {
        _rows.Clear();
        for (var i = 0; i < _pairs.Count; i++)
        {
            var pair = _pairs[i];
            var (first, second) = (_surfaces[pair.First], _surfaces[pair.Second]);
            if (_contacts[i].Count == 0)
            {
                continue;
            }

            if (first.Body!.IsAsleep || second.Body is { IsAsleep: true })
            {
                WakeIfPushed(first.Body.IsAsleep ? first.Body : second.Body!, first.Body.IsAsleep ? second.Body! : first.Body);
            }

            foreach (var contact in _contacts[i])
            {
                AddRow(in pair, in contact);
            }
        }
    }

    private void AddRow(in RigidPair pair, in ContactPoint contact)
    {
        var (first, second) = (_surfaces[pair.First], _surfaces[pair.Second]);
        var (body, other) = (first.Body!.Description, second.Body?.Description);
        var point = first.Motion.Origin + contact.Point;
        var least = Math.Abs(contact.Normal.X) < 0.6 ? Vector.I : Vector.J;
        var tangent = Vector.Cross(contact.Normal, least).UnitVector();
        var radius = Math.Min(first.Radius, second.Body?.Radius ?? double.PositiveInfinity);
        var belt = second.Target?.Kinematic is { } moved ? moved.Rotate(moved.Belt) : Vector.Zero;
        var row = new RigidRow
        {
            First = pair.First, Second = pair.Second, Normal = contact.Normal, Tangent1 = tangent,
            Tangent2 = Vector.Cross(contact.Normal, tangent), Arm1 = contact.Point, Arm2 = point - second.Motion.Origin,
            Gap = contact.Gap - pair.Distance, Distance = pair.Distance,
            BounceSpeed = _settings.RestitutionThreshold ?? 0.5 * _stepSeconds * _states[pair.First].Acceleration.Length(),
            Friction = Math.Min(body.Friction, other?.Friction ?? body.Friction),
            Restitution = Math.Min(body.Restitution, other?.Restitution ?? 1),
            RollingArm = Math.Min(body.RollingFriction, other?.RollingFriction ?? body.RollingFriction) * radius,
            SpinningArm = Math.Min(body.SpinningFriction, other?.SpinningFriction ?? body.SpinningFriction) * radius,
            Belt = belt - (Vector.Dot(belt, contact.Normal) * contact.Normal),
        };
        _cache.WarmStart(in pair, ref row, _states[pair.First].Orientation, radius);
        _states[pair.First].HasContacts = true;
        _states[pair.Second].HasContacts = true;
        _rows.Add(row);
    }

    /// <summary>Wakes what sleeps where something touches it that does not rest.</summary>
    private void WakeIfPushed(Body sleeper, Body other)
    {
        if (other.SleepTimer == 0)
        {
            WakeIsland(sleeper);
        }
    }

    /// <summary>Wakes what sleeps where objects come that move by themselves.</summary>
    private void WakeNearMoving()
    {
        foreach (var moved in _statics.Kinematics.Objects)
        {
            foreach (var body in moved.IsMoving ? _bodies : [])
            {
                if (body.IsAsleep && moved.SweptBounds.DistanceSquared(body.Position) <= body.Radius * body.Radius)
                {
                    WakeIsland(body);
                }
            }
        }
    }

    private void WakeIsland(Body sleeper)
    {
        foreach (var body in _bodies)
        {
            if (body.IsAsleep && (body == sleeper || body.RigidIsland == sleeper.RigidIsland))
            {
                body.Wake();
            }
        }
    }

    /// <summary>Sets the motions of a substep that the sweep tests: those that contacts leave, and free flight.</summary>
    /// <param name="time">When it begins, as a fraction of the part.</param>
    private void SetPlannedMotions(double time)
    {
        for (var i = 0; i < _surfaces.Count; i++)
        {
            ref var state = ref _states[i];
            var surface = _surfaces[i];
            if (!state.IsDynamic)
            {
                surface.Motion = surface.Body is null ? surface.PartMotion.Slice(time, _fraction) : surface.Motion.Stopped;
                continue;
            }

            if (!state.HasContacts)
            {
                RigidFlight.Fly(_bodies[i], ref state, _fraction * _seconds);
            }

            var turn = state.Turn.After(state.TurnBefore.Inverse());
            surface.SetMotion(state.Travel - state.TravelBefore, turn.RotationVector);
        }
    }

    /// <summary>Stops each body where it would come too close to another one, or to an object.</summary>
    private void Sweep()
    {
        for (_round = 0; _round < MaxSweepRounds; _round++)
        {
            RunOnPairs(static (stepper, pair, thread) => stepper.FindImpact(pair, thread));
            var hasStopped = false;
            for (var i = 0; i < _pairs.Count; i++)
            {
                if (_impacts[i] < 1)
                {
                    hasStopped |= Stop(_pairs[i].First, _impacts[i]) | Stop(_pairs[i].Second, _impacts[i]);
                }
            }

            if (!hasStopped)
            {
                return;
            }
        }

        StopIslands();
    }

    /// <summary>Stops all bodies that may meet, directly or through others, when the first one does: up to there all is free.</summary>
    private void StopIslands()
    {
        _islands.Reset(_surfaces.Count);
        foreach (var pair in _pairs)
        {
            if (_surfaces[pair.Second].Body is not null)
            {
                _islands.Join(pair.First, pair.Second);
            }
        }

        for (var i = _bodies.Count - 1; i >= 0; i--)
        {
            _ = Stop(_islands.RootOf(i), _surfaces[i].Fraction);
        }

        for (var i = 0; i < _bodies.Count; i++)
        {
            _ = Stop(i, _surfaces[_islands.RootOf(i)].Fraction);
        }
    }

    private bool Stop(int index, double fraction)
    {
        if (_surfaces[index].IsAwake && _states[index].IsDynamic && fraction < _surfaces[index].Fraction)
        {
            _surfaces[index].Fraction = fraction;
            return true;
        }

        return false;
    }

    private void FindImpact(int index, int thread)
    {
        var pair = _pairs[index];
        var (first, second) = (_surfaces[pair.First], _surfaces[pair.Second]);
        _impacts[index] = 1;
        var begin = Math.Min(first.Fraction, second.Fraction);
        var end = Math.Max(first.Fraction, second.Fraction);
        if (_round > 0 && begin == end)
        {
            return;
        }

        // At first both move. Then one of them has stopped, and the other goes on.
        var origin = first.Motion.Origin;
        var motion1 = (_round == 0 ? first.Motion : first.MotionAfter(begin)).RelativeTo(origin);
        var motion2 = (_round == 0 ? second.Motion : second.MotionAfter(begin)).RelativeTo(origin);
        var duration = _round == 0 ? 1 : end - begin;
        var distance = SweepDistance * pair.Distance;
        // What was looked at for contacts is all that may meet, unless both come closer than was thought then.
        var way = duration * MaxWay(first, in motion1, second, in motion2);
        _ways[index] += way;
        var impact = _searches[thread].Sweep.FindImpact(
            first.Shape.NodesOf(thread), in motion1, second.Shape.NodesOf(thread), in motion2, distance, duration,
            _ways[index] <= _margins[index] - (2 * distance) ? _near[index] : null);
        if (impact < duration)
        {
            _impacts[index] = _round == 0 ? impact : begin + impact;
        }
    }

    /// <summary>Moves all bodies by their motions, or to where these were stopped.</summary>
    /// <returns>True where one was stopped.</returns>
    private bool Commit()
    {
        var wasStopped = false;
        for (var i = 0; i < _bodies.Count; i++)
        {
            ref var state = ref _states[i];
            if (!state.IsDynamic)
            {
                continue;
            }

            var body = _bodies[i];
            var surface = _surfaces[i];
            if (surface.Fraction < 1)
            {
                wasStopped = true;
                state.Travel = state.TravelBefore + surface.Motion.From(surface.Fraction).Origin - surface.Motion.Origin;
                state.Turn = state.TurnBefore.TurnedBy(surface.Fraction * surface.Motion.Turn);
                state.UpdateInertia();
            }

            // What cannot move for a whole step loses the speed that it would otherwise gather.
            body.HeldCount = surface.Fraction < MinFraction ? body.HeldCount + 1 : 0;
            if (body.HeldCount >= MaxHeldCount)
            {
                state.Velocity *= 0.5;
                state.Spin *= 0.5;
            }

            body.Position += state.Travel - state.TravelBefore;
            body.SetOrientation(state.Turn.After(state.Orientation));
            body.Velocity = state.Velocity;
            body.AngularVelocity = state.Spin;
        }

        return wasStopped;
    }

    private void StoreContacts()
    {
        _cache.Clear();
        var rows = CollectionsMarshal.AsSpan(_rows);
        var start = 0;
        for (var i = 0; i < _pairs.Count; i++)
        {
            var count = _contacts[i].Count;
            _cache.Store(_pairs[i], rows.Slice(start, count), _states[_pairs[i].First].Orientation);
            foreach (ref readonly var row in rows.Slice(start, count))
            {
                if (row.NormalImpulseSum > 0 && _log.IsEnabled)
                {
                    var second = _surfaces[row.Second].Body?.Index ?? ContactRecord.OfObject(_surfaces[row.Second].Target!.Index);
                    _log.Add(row.First, second, _bodies[row.First].Position + row.Arm1, row.Normal, row.NormalImpulseSum);
                }
            }

            start += count;
        }
    }

    /// <summary>Puts bodies to sleep that have barely moved for some time, with all that touch them.</summary>
    private void Sleep(double seconds)
    {
        _islands.Reset(_surfaces.Count);
        foreach (var row in _rows)
        {
            if (_surfaces[row.Second].Body is not null && row.NormalImpulseSum > 0)
            {
                _islands.Join(row.First, row.Second);
            }
        }

        for (var i = 0; i < _bodies.Count; i++)
        {
            if (_bodies[i] is { IsAsleep: false } body)
            {
                var speed = _settings.SleepSpeed ?? 0.02 * Math.Sqrt(_states[i].Acceleration.Length() * body.Radius);
                var isSlow = (body.Position - body.PreviousPosition).Length() < speed * seconds
                    && body.AngularVelocity.Length() * body.Radius < speed;
                body.SleepTimer = isSlow && _states[i].HasContacts && !body.IsShrinking ? body.SleepTimer + seconds : 0;
            }
        }

        for (var i = 0; i < _bodies.Count; i++)
        {
            _bodies[i].IsRigidIslandAwake = false;
        }

        for (var i = 0; i < _bodies.Count; i++)
        {
            _bodies[_islands.RootOf(i)].IsRigidIslandAwake |= !_bodies[i].IsAsleep && !(_bodies[i].SleepTimer >= _settings.TimeBeforeSleep);
        }

        for (var i = 0; i < _bodies.Count; i++)
        {
            var body = _bodies[i];
            if (!body.IsAsleep && !_bodies[_islands.RootOf(i)].IsRigidIslandAwake)
            {
                body.Sleep();
                body.RigidIsland = _islands.RootOf(i);
            }
        }
    }
}
