using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Events;
using FractalEngine.Core.Physics.Islands;
using FractalEngine.Core.Physics.Movement;
using FractalEngine.Core.Physics.Rigid;
using FractalEngine.Core.Physics.Separation;
using FractalEngine.Core.Physics.Solving;
using FractalEngine.Core.Physics.Statics;
using FractalEngine.Core.Physics.Stepping;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Threading;

namespace FractalEngine.Core.Physics;

/// <summary>
/// Takes the bodies and the character of a world through its steps. Many balls act at the same time, on all threads; compounds, what has
/// filters and what is near moving objects act one after the other.
/// </summary>
internal sealed class WorldStepper
{
    // Less is done as soon by one thread.
    private const int BodiesPerJob = 1024;

    // Contacts and bodies that it may meet, of a ball in a heap.
    private const int ContactsPerBall = 4;

    // Relative to the radius of a body: how far an object goes in a part of a step at most.
    private const double MaxKinematicTravel = 0.25;

    // Parts of a step at most: what is so fast still passes no body that is free.
    private const int MaxParts = 64;

    // Room for so many bodies near a moving object; beyond it the list grows.
    private const int InitialNeighbourCapacity = 256;

    // Relative to the radius: how far a surface may be from where a body has touched it.
    private const double SurfaceSearchFraction = 0.01;

    private readonly List<Body> _bodies;
    private readonly StaticObjectSet _statics;
    private readonly KinematicSet _kinematics;
    private readonly BodyGrid _grid = new();
    private readonly NearbyBodies _nearbyBodies;
    private readonly List<int> _near = new(InitialNeighbourCapacity);
    private readonly IslandPlanner _planner;
    private readonly BodyStepper _stepper;
    private readonly IslandMover _islandMover;
    private readonly EnergyGuard _energyGuard;
    private readonly PhysicsSettings _settings;
    private readonly ParallelSteppers _parallel;
    private readonly RigidStepper _rigid;
    private readonly Action<BodyStepper, int> _prepare;
    private readonly Action<BodyStepper, int> _findNearSurfaces;
    private readonly Action<BodyStepper, int> _movePlanned;
    private readonly Action<BodyStepper, int> _finishPlanned;
    private int _bodyRoom;
    private int _contactRoom;

    // What the present part of a step is about.
    private CharacterController? _character;
    private Vector _gravity;
    private double _seconds;
    private bool _isFast;
    private bool _isFirstPart;
    private int _awakeCount;
    private bool _isAtRest;
    private Island _island;
    private StaticColliders? _sharedColliders;

    // Threads set it in any order, to the same.
    private volatile bool _hasOthers;

    public WorldStepper(PhysicsSettings settings, List<Body> bodies, StaticObjectSet statics)
    {
        _settings = settings;
        _bodies = bodies;
        _statics = statics;
        _kinematics = statics.Kinematics;
        _nearbyBodies = new(_grid, bodies);
        Islands = new(bodies, _nearbyBodies);
        BodySurfaces = new(bodies, statics);
        Obstacles = new(bodies, _nearbyBodies, QueryContext, _kinematics, BodySurfaces);
        ContactLog = new(bodies, statics) { IsEnabled = settings.ReportsContacts };
        var maxThreads = settings.MaxThreads ?? Environment.ProcessorCount;
        _planner = new(bodies, _nearbyBodies, ContactLog, new(), maxThreads);
        _stepper = CreateStepper(_nearbyBodies, Obstacles, QueryContext);
        _rigid = new(settings, bodies, statics, ContactLog, maxThreads);
        _islandMover = new(bodies, _planner.Islands, _grid, _nearbyBodies);
        _energyGuard = new(bodies, _planner.Islands);
        _parallel = new(
            context =>
            {
                var nearbyBodies = new NearbyBodies(_grid, bodies);
                return CreateStepper(nearbyBodies, new(bodies, nearbyBodies, context, _kinematics, BodySurfaces), context);
            },
            maxThreads);
        _prepare = Prepare;
        _findNearSurfaces = FindNearSurfaces;
        _movePlanned = MovePlanned;
        _finishPlanned = FinishPlanned;
    }

    /// <summary>Costs and scratch memory of all queries that one thread makes.</summary>
    public QueryContext QueryContext { get; } = new();

    /// <summary>Wakes bodies with all that touch them.</summary>
    public SleepIslands Islands { get; }

    /// <summary>What the character and casts meet, set up anew for each of them.</summary>
    public Obstacles Obstacles { get; }

    /// <summary>The surfaces of bodies that have the shape of their meshes.</summary>
    public BodySurfaces BodySurfaces { get; }

    /// <summary>The contacts of the last step.</summary>
    public ContactLog ContactLog { get; }

    /// <summary>What the joint solve of touching bodies has done.</summary>
    public IslandStatistics Statistics => _planner.Statistics;

    /// <summary>Triangles and bounding volumes that the last step tested.</summary>
    public (long FaceTests, long BoundTests) LastCost { get; private set; }

    /// <summary>True once forces act on bodies during the next step only.</summary>
    public bool HasStepForces { get; set; }

    private long StepCount => _statics.Clock.StepCount;

    private IslandSet IslandSet => _planner.Islands;

    private ContactGraph Graph => IslandSet.Graph;

    private BodyStepper CreateStepper(NearbyBodies nearbyBodies, Obstacles obstacles, QueryContext context) =>
        new(_settings, _bodies, _grid, nearbyBodies, obstacles, Islands, _planner, context, ContactLog);

    /// <summary>Puts all bodies into the grid, and makes room for their steps, which then allocate nothing.</summary>
    public void PlaceBodies()
    {
        _grid.Build(_bodies);
        _rigid.PlaceBodies();
        BodySurfaces.Place();
        _parallel.Reserve(_bodies.Count);
        _nearbyBodies.HasFilters = _bodies.Exists(static body => body.Description.Mask != Layers.All || body.Description.Layer != 0);
        var contactCount = ContactsPerBall * _bodies.Sum(static body => body.BallCount);
        if (_bodies.Count <= _bodyRoom && contactCount <= _contactRoom)
        {
            return;
        }

        // Twice as much as is needed, so that adding one by one takes linear time.
        _bodyRoom = 2 * _bodies.Count;
        _contactRoom = 2 * contactCount;
        QueryContext.MakeRoom();
        _stepper.Reserve(_bodyRoom);
        Islands.Reserve(_bodyRoom);
        _planner.Reserve(_bodyRoom, _contactRoom);
        _islandMover.Reserve(_bodyRoom);
        ContactLog.Reserve(_contactRoom);
    }

    /// <summary>Forgets all steps so far. The bodies are in their initial state.</summary>
    public void Reset()
    {
        _grid.Build(_bodies);
        ContactLog.Clear();
        _rigid.Reset();
        _rigid.PlaceBodies();
        BodySurfaces.Place();
        _planner.Reset();
        LastCost = default;
    }

    /// <summary>Takes all bodies and the character through one step.</summary>
    /// <param name="character">The active character; null for none.</param>
    /// <param name="gravity">Units per second².</param>
    /// <param name="seconds">Length of the step, positive and finite.</param>
    /// <exception cref="InvalidOperationException">A body has left the range of a double; the message names it.</exception>
    public void Step(CharacterController? character, Vector gravity, double seconds)
    {
        var before = CountTests();
        _character = character;
        _gravity = gravity;
        _kinematics.BeginStep(_statics.Clock.Time, seconds);
        character?.BeginStep();
        var parts = CountParts(seconds);
        _seconds = seconds / parts;
        _planner.PartsOfStep = parts;
        for (var part = 0; part < parts; part++)
        {
            _isFirstPart = part == 0;
            StepPart(_statics.Clock.Time + (part * seconds / parts));
        }

        for (var i = 0; HasStepForces && i < _bodies.Count; i++)
        {
            _bodies[i].StepForce = Vector.Zero;
            _bodies[i].StepTorque = Vector.Zero;
        }

        HasStepForces = false;
        if (ContactLog.IsEnabled)
        {
            FindTouchedSurfaces();
            FindTriggered();
            ContactLog.Finish();
        }

        _statics.Clock.Tick(seconds);
        var (faces, bounds) = CountTests();
        LastCost = (faces - before.Faces, bounds - before.Bounds);
    }

    private (long Faces, long Bounds) CountTests()
    {
        var (faces, bounds) = _parallel.CountTests();
        var (rigidFaces, rigidBounds) = _rigid.CountTests();
        return (QueryContext.Statistics.FaceTests + faces + rigidFaces, QueryContext.Statistics.BoundTests + bounds + rigidBounds);
    }

    /// <summary>
    /// Number of equal parts that a step is made in: several where an object goes far past the bodies before it, compared with them. In
    /// each part those that it pushes together find each other. Bodies that it carries along need none.
    /// </summary>
    private int CountParts(double seconds)
    {
        var parts = 1.0;
        _isFast = false;
        foreach (var moved in _kinematics.Objects)
        {
            var distance = moved.MaxSpeed * seconds;
            if (!(distance > 0))
            {
                continue;
            }

            if (_character is { } character && character.IsNear(moved.SweptBounds))
            {
                parts = Math.Max(parts, Math.Ceiling(distance / (MaxKinematicTravel * character.Description.Radius)));
            }

            foreach (var index in BodiesNear(moved.SweptBounds))
            {
                var body = _bodies[index];
                var beside = seconds * moved.MaxSpeedBeside(body.Velocity);
                if (distance > MaxParts * MaxKinematicTravel * body.Radius && (_rigid.IsNeeded || _bodies.Count > 1 || body.IsCompound))
                {
                    // It would get past what waits for others in a part.
                    _isFast = true;
                    continue;
                }

                parts = Math.Max(parts, Math.Ceiling(Math.Min(distance, beside) / (MaxKinematicTravel * body.Radius)));
            }
        }

        return (int)Math.Min(parts, MaxParts);
    }

    private List<int> BodiesNear(BoundingBox bounds)
    {
        _near.Clear();
        _nearbyBodies.CollectOverlaps(in bounds, 0, Contact.NoBody, _near);
        return _near;
    }

    /// <summary>Makes one of the parts of a step.</summary>
    private void StepPart(double time)
    {
        _awakeCount = 0;
        WorkerSet.Shared.Run(
            (_bodies.Count + BodiesPerJob - 1) / BodiesPerJob, _parallel.MaxThreads, this, static (stepper, job) => stepper.BeginPart(job));
        Islands.HasSleeping = _awakeCount < _bodies.Count;
        var wasAtRest = _isAtRest;
        _isAtRest = _awakeCount == 0 && _character is null && _kinematics.Objects.Count == 0;
        if (_isAtRest && wasAtRest)
        {
            // Nothing can happen: all sleep, and did so in the last part, which had nothing to plan.
            return;
        }

        _kinematics.BeginPart(time, _seconds);
        MoveBodies();
        if (_character is { } character)
        {
            StepCharacter(character);
        }

        _kinematics.EndPart();
    }

    private void MoveBodies()
    {
        if (_rigid.IsNeeded || _isFast)
        {
            BodySurfaces.Follow();
            _rigid.StepPart(_gravity, _seconds, _character);
            BodySurfaces.Follow(_seconds);
            for (var i = 0; i < _bodies.Count; i++)
            {
                _grid.Update(i);
            }

            return;
        }

        WakeNearKinematics();
        PlanIslands();
        MoveIslands();
        for (var i = 0; IslandSet.BodyCount < _bodies.Count && i < _bodies.Count; i++)
        {
            if (_bodies[i] is { IsAsleep: false, HasMoved: false, IslandIndex: < 0 })
            {
                StepBody(_bodies[i]);
            }
        }

        for (var i = 0; _kinematics.Objects.Count > 0 && i < _bodies.Count; i++)
        {
            if (_bodies[i] is { KinematicPush: > 0, IsAsleep: false, IsOverlapResolved: true })
            {
                _stepper.PushOut(_bodies[i], CollidersOf(_bodies[i]), _seconds);
            }
        }

        IslandSet.PutToSleep(_settings.TimeBeforeSleep);
    }

    private void BeginPart(int job)
    {
        var end = Math.Min(_bodies.Count, (job + 1) * BodiesPerJob);
        var awakeCount = 0;
        for (var i = job * BodiesPerJob; i < end; i++)
        {
            var body = _bodies[i];
            if (body.IsIdle && _kinematics.Objects.Count == 0)
            {
                continue;
            }

            if (_isFirstPart)
            {
                body.BeginStep();
                body.IsIdle = body.IsAsleep;
            }

            body.BeginPart();
            awakeCount += body.IsAsleep ? 0 : 1;
        }

        _ = Interlocked.Add(ref _awakeCount, awakeCount);
    }

    /// <summary>Wakes the bodies that objects may meet in the step.</summary>
    private void WakeNearKinematics()
    {
        foreach (var moved in _kinematics.Objects)
        {
            if (!moved.IsMoving || !Islands.HasSleeping)
            {
                continue;
            }

            foreach (var index in BodiesNear(moved.SweptBounds))
            {
                var body = _bodies[index];
                if (body.IsAsleep && _stepper.IsNearKinematic(body, CollidersOf(body), moved.MaxSpeed * _seconds))
                {
                    Islands.Wake(body);
                }
            }
        }
    }

    /// <summary>Prepares all bodies that are awake, and solves their islands.</summary>
    private void PlanIslands()
    {
        do
        {
            _ = RunOnBodies(_bodies.Count, _awakeCount, _prepare);
        }
        while (Graph.CollectTouching(Islands, _seconds));

        Graph.JoinTouching();
        _planner.StopApproaches();
        Graph.JoinForStep();
        if (Graph.Sets.JoinedCount > 0)
        {
            _ = RunOnBodies(_bodies.Count, Graph.Sets.JoinedCount, _findNearSurfaces);
        }

        _planner.Plan(_seconds);
    }

    /// <summary>
    /// Lets the first bodies of the world act, or those of an island: balls at the same time where nothing moves by itself and all see the
    /// same colliders, then those that are left one after the other.
    /// </summary>
    /// <param name="count">Number of the bodies.</param>
    /// <param name="activeCount">Number of those that have anything to do.</param>
    /// <param name="act">Lets the body of an index below that act, unless it has done so, or may not with this stepper.</param>
    /// <returns>False where all have acted at the same time, and nothing has to be looked at.</returns>
    private bool RunOnBodies(int count, int activeCount, Action<BodyStepper, int> act)
    {
        _hasOthers = true;
        if (ParallelSteppers.AreMany(activeCount) && _kinematics.Objects.Count == 0 && !_nearbyBodies.HasFilters && !_statics.HasFilters)
        {
            _hasOthers = false;
            _sharedColliders = CollidersOf(_bodies[0]);
            _parallel.Run(count, act);
        }

        for (var i = 0; _hasOthers && i < count; i++)
        {
            act(_stepper, i);
        }

        return _hasOthers;
    }

    /// <summary>Tells whether a body may act with a stepper: bodies that differ from most wait for that of the world.</summary>
    private bool MayAct(BodyStepper stepper, Body body, out StaticColliders? colliders)
    {
        if (stepper == _stepper)
        {
            colliders = CollidersOf(body);
            return true;
        }

        colliders = _sharedColliders;
        if (body.IsOverlapResolved && !body.IsCompound && _statics.KindFor(body.Description) == _statics.KindFor(_bodies[0].Description))
        {
            return true;
        }

        _hasOthers = true;
        return false;
    }

    private StaticColliders? CollidersOf(Body body) => _statics.CollidersOf(body.Description);

    private void Prepare(BodyStepper stepper, int index)
    {
        if (_bodies[index] is { IsAsleep: false, IsPrepared: false } body && MayAct(stepper, body, out var colliders))
        {
            stepper.Prepare(body, colliders, _character, _gravity, _seconds);
        }
    }

    /// <summary>Finds the surfaces that a body of an island may meet, unless they are known.</summary>
    private void FindNearSurfaces(BodyStepper stepper, int index)
    {
        if (Graph.Sets.IsJoined(index) && !_bodies[index].AreNearSurfacesKnown && MayAct(stepper, _bodies[index], out var colliders))
        {
            _bodies[index].AreNearSurfacesKnown = true;
            stepper.FindNearSurfaces(_bodies[index], colliders, Graph.Copies[index].Reach, _seconds);
        }
    }

    /// <summary>Moves the bodies of all islands at once.</summary>
    private void MoveIslands()
    {
        var hasMovedAhead = MoveObstructing();
        foreach (var island in IslandSet.All)
        {
            _island = island;
            _ = RunOnBodies(island.BodyCount, island.BodyCount, _movePlanned);
        }

        _islandMover.ReturnOverlapping(_planner.HasDeepOverlaps || hasMovedAhead);
        foreach (var island in IslandSet.All)
        {
            _energyGuard.FinishVelocities(in island);

            _island = island;
            _ = RunOnBodies(island.BodyCount, island.BodyCount, _finishPlanned);
        }
    }

    /// <summary>Moves bodies of no island first that stand where those of islands will be, such as what falls ahead of them.</summary>
    /// <returns>True where there are such.</returns>
    private bool MoveObstructing()
    {
        var hasMoved = false;
        for (var pair = 0; _islandMover.FindObstructing(ref pair) is { } body; hasMoved = true)
        {
            if (!hasMoved)
            {
                AddStartEnergies(-1);
            }

            StepBody(body);
        }

        if (hasMoved)
        {
            AddStartEnergies(1);
        }

        return hasMoved;
    }

    /// <summary>Takes or gives the energies that bodies have: between both, what has moved ahead may push them.</summary>
    private void AddStartEnergies(double share)
    {
        foreach (var body in _bodies)
        {
            body.PlannedStartEnergy += share * body.KineticEnergy;
        }
    }

    private void MovePlanned(BodyStepper stepper, int place)
    {
        var body = _bodies[IslandSet.BodiesOf(in _island)[place]];
        if (!body.IsMovedAhead && MayAct(stepper, body, out var colliders))
        {
            body.IsMovedAhead = true;
            Move(stepper, body, colliders, isPlanned: true);
        }
    }

    /// <summary>Ends the step of a body of an island.</summary>
    private void FinishPlanned(BodyStepper stepper, int place)
    {
        var body = _bodies[IslandSet.BodiesOf(in _island)[place]];
        if (!body.IsFinished && MayAct(stepper, body, out var colliders))
        {
            stepper.FinishPlanned(body, colliders, _seconds, StepCount);
        }

        if (stepper == _stepper)
        {
            stepper.CommitPosition(body);
        }
        else if (body.IsFinished && !stepper.TryCommitPosition(body))
        {
            _hasOthers = true;
        }
    }

    private void StepBody(Body body)
    {
        Prepare(_stepper, body.Index);
        body.HasMoved = true;
        Move(_stepper, body, CollidersOf(body), isPlanned: false);
    }

    private void Move(BodyStepper stepper, Body body, StaticColliders? colliders, bool isPlanned)
    {
        try
        {
            if (isPlanned)
            {
                stepper.MovePlanned(body, colliders, _character, _seconds);
            }
            else
            {
                stepper.Step(body, colliders, _character, _seconds, StepCount);
            }
        }
        catch (ArgumentOutOfRangeException exception) when (exception.ActualValue is Vector)
        {
            throw CreateRangeException($"body {body.Name}", exception);
        }
    }

    private void StepCharacter(CharacterController character)
    {
        try
        {
            // The ground carries it first. Then it walks among objects where they are at the end of the step.
            _kinematics.Time = 0;
            character.Carry(_seconds);
            _kinematics.Time = _seconds;
            _kinematics.IsFrozen = true;
            character.Step(_statics.CollidersOf(_statics.CharacterKind), _gravity, _seconds);
        }
        catch (ArgumentOutOfRangeException exception) when (exception.ActualValue is Vector)
        {
            throw CreateRangeException("the character", exception);
        }
        finally
        {
            _kinematics.IsFrozen = false;
        }

        if (!(character.Position.IsFinite() && character.Velocity.IsFinite()))
        {
            throw CreateRangeException("the character", null);
        }
    }

    // Its cause is a query of a position on the way that is none.
    private InvalidOperationException CreateRangeException(string subject, ArgumentOutOfRangeException? cause) =>
        new($"{subject} has left the range of a double in step {StepCount}", cause);

    /// <summary>Finds what surfaces bodies have touched.</summary>
    private void FindTouchedSurfaces()
    {
        foreach (ref var record in ContactLog.Records)
        {
            if (record.Second == ContactRecord.Unknown)
            {
                var body = _bodies[record.First];
                // By a bounce and its way in the rest of the step.
                var tolerance = (SurfaceSearchFraction * body.Radius) + (body.Position - body.PreviousPosition).Length();
                var touched = CollidersOf(body)?.FindClosest(record.Point, tolerance, QueryContext, out _);
                record = touched is null ? record : record with { Second = ContactRecord.OfObject(touched.Index) };
            }
        }
    }

    /// <summary>Finds which triggers bodies are in.</summary>
    private void FindTriggered()
    {
        foreach (var trigger in _statics.Objects)
        {
            if (!trigger.IsTrigger)
            {
                continue;
            }

            foreach (var index in BodiesNear(trigger.Bounds))
            {
                var body = _bodies[index];
                var canMeet = Layers.CanMeet(trigger.Layer, trigger.Mask, body.Description.Layer, body.Description.Mask);
                if (canMeet && body.Description.Mesh is not null && _rigid.TryEnter(body, trigger, QueryContext, out var point))
                {
                    ContactLog.Add(index, ContactRecord.OfObject(trigger.Index), point, (body.Position - point).UnitVectorOrZero(), 0);
                }

                for (var ball = 0; ball < body.BallCount && canMeet; ball++)
                {
                    var centre = body.BallCentre(ball);
                    if (_statics.TryEnter(trigger, centre, body.BallRadius(ball), QueryContext, out var closest))
                    {
                        ContactLog.Add(index, ContactRecord.OfObject(trigger.Index), closest, (centre - closest).UnitVectorOrZero(), 0);
                    }
                }
            }
        }
    }
}
