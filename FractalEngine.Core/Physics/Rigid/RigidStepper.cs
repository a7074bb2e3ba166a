using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Events;
using FractalEngine.Core.Physics.Movement;
using FractalEngine.Core.Physics.Statics;
using FractalEngine.Core.Queries;

namespace FractalEngine.Core.Physics.Rigid;

/// <summary>
/// Takes the bodies of a world through a step in which bodies have the shape of their meshes: gathers what may meet, finds the contacts,
/// solves them, moves everything until it touches, and puts to sleep what rests.
/// </summary>
internal sealed class RigidStepper(PhysicsSettings settings, List<Body> bodies, StaticObjectSet statics, ContactLog log, int maxThreads)
{
    // Radians that a body turns in a substep at most.
    private const double MaxAngle = 0.5;

    // Substeps of a step, and at most so many where bodies turn fast.
    private const int MinSubsteps = 8;
    private const int MaxSubsteps = 1024;

    // So often are substeps cut short so that nothing turns too far in them.
    private const int MaxCuts = 64;

    // So often does what moves by itself push a body in a step; then it carries it.
    private const int MaxPushes = 16;

    // What makes a smaller part of its way counts as held.
    private const double MinFraction = 0.01;

    private readonly Dictionary<object, RigidShape> _shapes = [];
    private readonly List<RigidSurface> _surfaces = [];
    private readonly RigidPairSet _pairs = new(maxThreads);
    private readonly List<RigidPair> _searched = [];
    private readonly List<RigidRow> _rows = [];
    private readonly List<RigidRow> _renewed = [];
    private readonly RigidSweep _sweep = new();
    private readonly RigidEnergyGuard _guard = new();
    private readonly RigidSleep _sleep = new(settings, bodies);
    private RigidState[] _states = [];
    private RigidSurface? _character;
    private Vector _gravity;
    private double _seconds;
    private bool _isMoving;

    /// <summary>True where a body of the world has the shape of its mesh, so that this takes all bodies through their steps.</summary>
    public bool IsNeeded { get; private set; }

    /// <summary>Finds out whether a body has the shape of its mesh.</summary>
    public void PlaceBodies() => IsNeeded = bodies.Exists(static body => body.Description.Mesh is not null);

    /// <summary>Forgets the contacts of all steps so far.</summary>
    public void Reset()
    {
        _pairs.Clear();
        _rows.Clear();
    }

    /// <summary>Counts the tests of all searches so far.</summary>
    public (long Faces, long Bounds) CountTests() => _pairs.CountTests();

    /// <summary>Takes all bodies through a step, or one of the parts in which objects move.</summary>
    /// <param name="gravity">Units per second².</param>
    /// <param name="seconds">Length of the part.</param>
    /// <param name="character">A character that stands in the way; null for none.</param>
    public void StepPart(Vector gravity, double seconds, CharacterController? character)
    {
        GatherBodies();
        GatherCharacter(character, isTurned: gravity != _gravity);
        _gravity = gravity;
        _seconds = seconds;
        _isMoving = false;
        _sleep.WakeNearMoving(statics);
        var angle = 0.0;
        for (var i = 0; i < _surfaces.Count; i++)
        {
            _surfaces[i].Carrier = null;
            _surfaces[i].PushCount = 0;
            if (_surfaces[i].Body is not { } body)
            {
                _states[i] = CreateState(_surfaces[i]);
                continue;
            }

            if (!body.IsAsleep)
            {
                body.Shrink(seconds);
            }

            BeginBody(i);
            angle = Math.Max(angle, _states[i].Spin.Length() * seconds);
        }

        FindContacts(0);
        var count = _pairs.Pairs.Count == 0 && angle <= MaxAngle ? 1
            : (int)Math.Clamp(Math.Ceiling(angle / MaxAngle), MinSubsteps, MaxSubsteps);
        var cuts = 0;
        var maxCuts = count + MaxSubsteps + (MaxPushes * bodies.Count);
        for (var i = 0; i < count; i++)
        {
            // A substep ends early where an object that moves by itself meets a body, which it pushes from then on.
            for (var made = 0.0; made < 1;)
            {
                var time = (i + made) / count;
                if (time > 0)
                {
                    FindContacts(time);
                }

                var cut = MoveSubstep(time, (1 - made) / count, canTurn: cuts >= count + MaxCuts, canCut: cuts < maxCuts);
                cuts++;
                made = cut < 1 ? made + (cut * (1 - made)) : 1;
            }
        }

        EndStep();
    }

    /// <summary>Tells whether a body of a mesh reaches into an object: through its surface, or inside where it is closed.</summary>
    /// <param name="body">The body.</param>
    /// <param name="target">The object.</param>
    /// <param name="context">Receives the cost.</param>
    /// <param name="point">Receives a point of the body there.</param>
    public bool TryEnter(Body body, StaticObject target, QueryContext context, out Vector point)
    {
        var nodes = ShapeOf(body).NodesOf(0);
        var motion = new SurfaceMotion(Vector.Zero, body.Orientation, body.Scale, Vector.Zero, Vector.Zero);
        point = body.Position + (motion.Map * nodes.AnyPoint());
        var pose = target.Kinematic?.Pose ?? new(target.ObjectToWorld.Translation, Orientation.Identity);
        var otherMotion = new SurfaceMotion(pose.Position - body.Position, pose.Orientation, 1, Vector.Zero, Vector.Zero);
        var distance = RigidPairSet.ContactDistance * body.Radius;
        if (_pairs.TryFindTouch(nodes, in motion, ShapeOf(target).NodesOf(0), in otherMotion, distance, out var touch))
        {
            point = body.Position + touch;
            return true;
        }

        return statics.TryEnter(target, point, 0, context, out _);
    }

    /// <summary>Lists all bodies, then all objects that stop something.</summary>
    private void GatherBodies()
    {
        var count = bodies.Count + statics.Objects.Count;
        for (var i = 0; i < count; i++)
        {
            var body = i < bodies.Count ? bodies[i] : null;
            var target = i < bodies.Count ? null : statics.Objects[i - bodies.Count];
            if (i < _surfaces.Count && _surfaces[i].Body == body && _surfaces[i].Target == target && !_surfaces[i].IsShapeOld)
            {
                continue;
            }

            if (target is not null && i < _surfaces.Count && _surfaces[i].Target == target)
            {
                // Objects of the same shape keep it; what is turned in each step leaves none behind.
                _ = _shapes.Remove((target.Model, _surfaces[i].Linear, true));
            }

            _surfaces.RemoveRange(Math.Min(i, _surfaces.Count), Math.Max(0, _surfaces.Count - i));
            _surfaces.Add(body is not null ? new(body, ShapeOf(body)) : new(target!, ShapeOf(target!)));
        }

        _surfaces.RemoveRange(count, _surfaces.Count - count);
    }

    /// <summary>Adds the character, which stands in the way of bodies, and begins the step of all surfaces.</summary>
    private void GatherCharacter(CharacterController? character, bool isTurned)
    {
        if (character is not null)
        {
            if (_character?.Character != character || isTurned)
            {
                _character = new(character);
                _character.Shape.Reserve(maxThreads);
            }

            _surfaces.Add(_character);
        }

        var hasTrimmed = false;
        foreach (var surface in _surfaces)
        {
            surface.BeginStep();
            hasTrimmed |= surface.Shape.Trim();
        }

        if (hasTrimmed)
        {
            _pairs.ForgetNear();
        }

        if (_states.Length < _surfaces.Count)
        {
            _states = new RigidState[2 * _surfaces.Count];
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
            shape.Reserve(maxThreads);
            _shapes[key] = shape;
        }

        return shape;
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

    private RigidState CreateState(RigidSurface surface)
    {
        var state = new RigidState { Turn = Orientation.Identity, Orientation = Orientation.Identity };
        if (surface.Target?.Kinematic is not { } moved)
        {
            surface.Stand();
            return state;
        }

        state.Velocity = moved.Velocity;
        state.Spin = moved.AngularVelocity;
        state.Orientation = moved.Pose.Orientation;
        surface.PartMotion = new(
            moved.Pose.Position, state.Orientation, 1, _seconds * moved.Velocity, _seconds * moved.AngularVelocity);
        surface.Motion = surface.PartMotion;
        surface.SweptBounds = moved.SweptBounds;
        surface.Carrier = moved.IsMoving ? surface : null;
        _isMoving |= moved.IsMoving;
        return state;
    }

    /// <summary>Finds the contacts that are not known yet.</summary>
    /// <param name="time">Now, as a fraction of the step.</param>
    private void FindContacts(double time)
    {
        var hasFound = false;
        while (_surfaces.Exists(static surface => surface.IsReachDue) || _pairs.Pairs.Exists(static pair => pair.IsSearchDue))
        {
            if (!hasFound)
            {
                KeepRows();
            }

            if (SetRest(time))
            {
                _pairs.Find(_surfaces, bodies.Count, isStepBegun: time > 0 || hasFound);
            }

            _pairs.FindContacts(_searched);
            WakePushed();
            foreach (var pair in _searched)
            {
                RenewRows(pair);
            }

            hasFound = true;
        }

        if (hasFound)
        {
            ListRows();
        }
    }

    /// <summary>Sets where everything gets to in the rest of the step without contacts.</summary>
    /// <param name="time">When that begins, as a fraction of the step.</param>
    /// <returns>True where something may get farther than what it may meet has been looked for.</returns>
    private bool SetRest(double time)
    {
        var rest = (1 - time) * _seconds;
        var isReachNew = false;
        for (var i = 0; i < _surfaces.Count; i++)
        {
            ref readonly var state = ref _states[i];
            if (_surfaces[i].Body is null)
            {
                _surfaces[i].Motion = _surfaces[i].PartMotion.Slice(time, 1 - time);
            }
            else
            {
                isReachNew |= _surfaces[i].SetRest((rest * state.Velocity) + (rest * rest * state.Acceleration), rest * state.Spin);
            }
        }

        return isReachNew;
    }

    /// <summary>Wakes bodies that something touches which does not rest, with all that fell asleep with them.</summary>
    private void WakePushed()
    {
        var hasWoken = false;
        foreach (var pair in _searched)
        {
            hasWoken |= pair.Contacts.Count > 0 && pair.Second.Body is { } second && _sleep.WakeIfPushed(pair.First.Body!, second);
        }

        for (var i = 0; hasWoken && i < bodies.Count; i++)
        {
            if (!bodies[i].IsAsleep && !_states[i].IsDynamic)
            {
                BeginBody(i);
            }
        }
    }

    private void BeginBody(int index)
    {
        _states[index] = CreateState(bodies[index]);
        _surfaces[index].IsReachDue = true;
    }

    /// <summary>Makes the rows of the contacts that have been found. They begin with the impulses of the nearest ones before.</summary>
    private void RenewRows(RigidPair pair)
    {
        LogContacts(CollectionsMarshal.AsSpan(pair.Rows));
        _renewed.Clear();
        foreach (ref readonly var contact in CollectionsMarshal.AsSpan(pair.Contacts))
        {
            var row = CreateRow(pair, in contact);
            row.WarmStart(CollectionsMarshal.AsSpan(pair.Rows), pair.Radius);
            _renewed.Add(row);
        }

        pair.Rows.Clear();
        pair.Rows.AddRange(_renewed);
    }

    private RigidRow CreateRow(RigidPair pair, in ContactPoint contact)
    {
        ref readonly var state1 = ref _states[pair.FirstIndex];
        ref readonly var state2 = ref _states[pair.SecondIndex];
        var (body, other) = (pair.First.Body!.Description, pair.Second.Body?.Description);
        var arm1 = state1.Turn.RotateBack(contact.Point);
        var arm2 = state2.Turn.RotateBack(pair.First.Motion.Origin + contact.Point - pair.Second.Motion.Origin);
        var tangent = contact.Normal.Perpendicular();
        var belt = pair.Second.Target?.Kinematic is { } moved ? moved.Rotate(moved.Belt) : Vector.Zero;
        return new()
        {
            First = pair.FirstIndex, Second = pair.SecondIndex, Normal = contact.Normal, Tangent1 = tangent,
            Tangent2 = Vector.Cross(contact.Normal, tangent), Arm1 = arm1, Arm2 = arm2,
            LocalArm1 = state1.Orientation.RotateBack(arm1), Offset = state2.TravelOf(arm2) - state1.TravelOf(arm1),
            Gap = contact.Gap - pair.Distance, Distance = pair.Distance,
            BounceSpeed = settings.RestitutionThreshold ?? 0.5 * _seconds * state1.Acceleration.Length(),
            Friction = Math.Min(body.Friction, other?.Friction ?? body.Friction),
            Restitution = Math.Min(body.Restitution, other?.Restitution ?? 1),
            RollingArm = Math.Min(body.RollingFriction, other?.RollingFriction ?? body.RollingFriction) * pair.Radius,
            SpinningArm = Math.Min(body.SpinningFriction, other?.SpinningFriction ?? body.SpinningFriction) * pair.Radius,
            Belt = belt - (Vector.Dot(belt, contact.Normal) * contact.Normal),
        };
    }

    /// <summary>Lists the rows of all pairs for the solver.</summary>
    private void ListRows()
    {
        _rows.Clear();
        for (var i = 0; i < _surfaces.Count; i++)
        {
            _states[i].HasContacts = false;
        }

        foreach (var pair in _pairs.Pairs)
        {
            if (pair.Rows.Count > 0)
            {
                _rows.AddRange(CollectionsMarshal.AsSpan(pair.Rows));
                _states[pair.FirstIndex].HasContacts = true;
                _states[pair.SecondIndex].HasContacts = true;
            }
        }
    }

    /// <summary>Gives the rows that have been solved back to their pairs.</summary>
    private void KeepRows()
    {
        var solved = CollectionsMarshal.AsSpan(_rows);
        foreach (var pair in _pairs.Pairs)
        {
            var rows = CollectionsMarshal.AsSpan(pair.Rows);
            solved[..Math.Min(rows.Length, solved.Length)].CopyTo(rows);
            solved = solved[Math.Min(rows.Length, solved.Length)..];
        }
    }

    /// <summary>Moves everything on until it touches.</summary>
    /// <param name="time">Now, as a fraction of the step.</param>
    /// <param name="fraction">Length of the substep, relative to the step.</param>
    /// <param name="canTurn">True to let bodies turn as far as they do.</param>
    /// <param name="canCut">False to let objects that move by themselves go on, whatever they meet.</param>
    /// <returns>The part of the substep that has been made.</returns>
    private double MoveSubstep(double time, double fraction, bool canTurn, bool canCut)
    {
        var states = _states.AsSpan(0, _surfaces.Count);
        foreach (ref var state in states)
        {
            state.BeginSubstep();
        }

        var substep = fraction * _seconds;
        _guard.Begin(states, CollectionsMarshal.AsSpan(_rows));
        var made = RigidSolver.Solve(
            states, CollectionsMarshal.AsSpan(_rows), substep, _isMoving && !canTurn ? MaxAngle : double.PositiveInfinity);
        PlanMotions(time, made < substep ? made / _seconds : fraction);
        _sweep.StopBodies(_pairs, _surfaces);
        var cut = canCut && _isMoving ? FirstPush(made) : 1;
        for (var i = 0; i < _surfaces.Count; i++)
        {
            if (cut < 1)
            {
                _ = _surfaces[i].Stop(cut);
            }

            if (i < bodies.Count)
            {
                Commit(_surfaces[i], ref _states[i], made, isTimeKept: cut < 1 && _surfaces[i].Fraction == cut);
            }
            else
            {
                _states[i].Shorten(cut);
            }
        }

        _guard.End(states);
        for (var i = 0; i < bodies.Count; i++)
        {
            if (states[i].IsDynamic)
            {
                bodies[i].Velocity = states[i].Velocity;
                bodies[i].AngularVelocity = states[i].Spin;
            }
        }

        foreach (var pair in _pairs.Pairs)
        {
            pair.EndSubstep();
        }

        return cut * (made / substep);
    }

    /// <summary>
    /// The part of the substep after which the first object that moves by itself meets a body; 1 where none does. What it has met too
    /// often it carries from then on.
    /// </summary>
    private double FirstPush(double seconds)
    {
        var first = 1.0;
        foreach (var surface in _surfaces)
        {
            first = surface is { Body: not null, Carrier: not null, IsReachDue: true } ? Math.Min(first, surface.Fraction) : first;
        }

        foreach (var pair in _pairs.Pairs)
        {
            first = pair.Push is not null ? Math.Min(first, pair.FirstImpact) : first;
        }

        foreach (var pair in _pairs.Pairs)
        {
            if (first < 1 && pair.FirstImpact <= first && pair.Push is { } push && push.Met.PushCount++ >= MaxPushes)
            {
                push.Met.Carrier = push.Carrier;
                push.Met.IsReachDue = true;
                _states[push.Index].Velocity = push.Carrier.Motion.From(first).VelocityAt(push.Met.Body!.Position) / seconds;
            }
        }

        return first;
    }

    /// <summary>Plans the motions of a substep: those that contacts leave, and free flight.</summary>
    private void PlanMotions(double time, double fraction)
    {
        for (var i = 0; i < _surfaces.Count; i++)
        {
            ref var state = ref _states[i];
            var surface = _surfaces[i];
            if (!state.IsDynamic)
            {
                surface.Motion = surface.Body is null ? surface.PartMotion.Slice(time, fraction) : surface.Motion.Stopped;
                continue;
            }

            if (surface.Carrier is { } carrier)
            {
                surface.SetCarriedMotion(carrier.PartMotion.Slice(time, fraction));
                state.Velocity = surface.Motion.From(1).VelocityAt(surface.Motion.From(1).Origin) / (fraction * _seconds);
                state.Spin = state.LocalInverseInertia == default ? Vector.Zero : surface.Motion.Turn / (fraction * _seconds);
                state.Travel = state.TravelBefore + surface.Motion.From(1).Origin - surface.Motion.Origin;
                state.Turn = state.TurnBefore.TurnedBy(surface.Motion.Turn);
                continue;
            }

            if (!state.HasContacts)
            {
                RigidFlight.Fly(bodies[i], ref state, fraction * _seconds);
            }

            var turn = state.Turn.After(state.TurnBefore.Inverse());
            surface.SetMotion(state.Travel - state.TravelBefore, turn.RotationVector, state.Pivot);
        }
    }

    /// <summary>Moves a body by its motion, or to where this was stopped.</summary>
    private static void Commit(RigidSurface surface, ref RigidState state, double seconds, bool isTimeKept)
    {
        if (!state.IsDynamic)
        {
            return;
        }

        var displacement = state.Travel - state.TravelMoved;
        if (surface.Fraction < 1)
        {
            var energy = state.KineticEnergy - (Vector.Dot(state.Acceleration, state.Travel) / state.InverseMass);
            state.Travel = state.TravelBefore + surface.Motion.From(surface.Fraction).Origin - surface.Motion.Origin;
            state.TurnTo(state.TurnBefore.TurnedBy(surface.Fraction * surface.Motion.Turn), state.Turn);
            // It has not fallen for the rest of the time, which it has still before it, or loses.
            var unmade = (1 - surface.Fraction) * seconds * state.Acceleration;
            var part = isTimeKept ? 1 : Vector.Dot(state.Velocity, unmade) / unmade.LengthSquared();
            state.Velocity -= part > 0 ? Math.Min(part, 1) * unmade : Vector.Zero;
            // Nor does it keep what that fall made of its speed along surfaces and of its spin.
            state.LimitEnergy(energy + (Vector.Dot(state.Acceleration, state.Travel) / state.InverseMass));
        }

        // What leaves a contact too slowly for its turn is stopped at once, again and again: first it needs the gap that it lacks.
        state.IsHeld = surface.Fraction < MinFraction && !isTimeKept && !state.IsHeld;
        var travel = state.Travel - state.TravelBefore;
        // What rests may be lifted a little against gravity, for nothing. What has turned into others, and is lifted more, pays for it.
        var lift = (surface.Fraction * displacement).ShortenedTo(RigidPairSet.ContactDistance * surface.Radius);
        state.Work = surface.Carrier is null
            ? Vector.Dot(state.Acceleration, travel - lift) / state.InverseMass : double.PositiveInfinity;
        surface.Body!.Position += travel;
        surface.Body.SetOrientation(state.Turn.After(state.Orientation));
    }

    private void EndStep()
    {
        LogContacts(CollectionsMarshal.AsSpan(_rows));
        _sleep.EndStep(_states, CollectionsMarshal.AsSpan(_rows), _seconds);
        foreach (ref var row in CollectionsMarshal.AsSpan(_rows))
        {
            row.EndStep(in _states[row.First], in _states[row.Second]);
        }

        KeepRows();
        _surfaces.ForEach(static surface => surface.EndStep());
    }

    private void LogContacts(ReadOnlySpan<RigidRow> rows)
    {
        foreach (ref readonly var row in rows)
        {
            var other = _surfaces[row.Second];
            if (row.NormalImpulseSum > 0 && log.IsEnabled && other != _character)
            {
                var second = other.Body?.Index ?? ContactRecord.OfObject(other.Target!.Index);
                log.Add(row.First, second, bodies[row.First].Position + row.TurnedArm1, row.Normal, row.NormalImpulseSum);
            }
        }
    }
}
