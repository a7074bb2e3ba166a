using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Rows;
using FractalEngine.Core.Threading;

namespace FractalEngine.Core.Physics.Islands;

/// <summary>What searches and contacts read of bodies, copied on all threads: they read those of many.</summary>
internal sealed class BodyCopies(List<Body> bodies, int maxThreads)
{
    /// <summary>Bodies are copied and searched for in groups: at most so many.</summary>
    public const int MaxGroups = 64;

    // Smaller groups cost more than they save.
    private const int MinBodiesOfGroup = 64;

    // Relative to the radius: how much farther than its free path a body is expected to get, pushed by others.
    private const double ReachMargin = 0.1;

    // Relative to the radius: bodies that get farther do not search for all that they may meet before it is known that they touch anything.
    private const double MaxEarlyDistance = 4;

    private readonly Group[] _groups = [.. Enumerable.Range(0, MaxGroups).Select(static _ => new Group())];
    private GraphBody[] _states = [];
    private BodyMaterial[] _materials = [];
    private BodyDescription?[] _descriptions = [];
    private int _bodiesPerGroup = MinBodiesOfGroup;
    private int _groupCount;

    // The bodies of which the copy of an earlier step holds as long as they sleep, with how often they had fallen asleep then.
    private (Body? Body, int SleepCount)[] _idleCopies = [];

    /// <summary>The groups of bodies, each of which one thread looks at.</summary>
    public ReadOnlySpan<Group> Groups => _groups.AsSpan(0, _groupCount);

    /// <summary>All bodies, in the order of their indices.</summary>
    public Span<GraphBody> All => _states.AsSpan(0, bodies.Count);

    /// <summary>Seconds that the present step takes.</summary>
    public double StepLength { get; private set; }

    /// <summary>True where a kinematic object pushes a body when the step begins.</summary>
    public bool ArePushed { get; private set; }

    /// <summary>True where a body may sleep.</summary>
    public bool HasSleeping { get; private set; }

    /// <summary>What a grid of all bodies holds.</summary>
    public GridBounds Bounds { get; private set; }

    /// <summary>The copy of a body by its index in the world.</summary>
    public ref GraphBody this[int body] => ref _states[body];

    /// <summary>Friction, restitution and the like of a body, by its index in the world.</summary>
    public ref readonly BodyMaterial MaterialOf(int body) => ref _materials[body];

    /// <summary>Indices of the bodies of a group, the last one excluded.</summary>
    public (int First, int End) BodiesOf(int group) =>
        (group * _bodiesPerGroup, Math.Min(bodies.Count, (group + 1) * _bodiesPerGroup));

    /// <summary>Makes room for the bodies of a world.</summary>
    public void Reserve(int bodyCount)
    {
        _states = new GraphBody[bodyCount];
        _materials = new BodyMaterial[bodyCount];
        _descriptions = new BodyDescription?[bodyCount];
        _idleCopies = new (Body?, int)[bodyCount];
        SetGroups();
    }

    /// <summary>Forgets all groups: no body may touch another one.</summary>
    public void Clear(double stepLength) => (StepLength, _groupCount) = (stepLength, 0);

    /// <summary>Copies all bodies as they are when their step begins.</summary>
    public void CopyAll()
    {
        SetGroups();
        WorkerSet.Shared.Run(_groupCount, maxThreads, this, static (copies, group) => copies.Copy(group));
        (HasSleeping, ArePushed) = (false, false);
        Bounds = GridBounds.None;
        foreach (var group in Groups)
        {
            HasSleeping |= group.HasSleeping;
            ArePushed |= group.HasPushed;
            Bounds = GridBounds.Union(Bounds, group.Bounds);
        }
    }

    /// <summary>Copies what impacts have changed, and tells bodies whether they touch others.</summary>
    public void UpdateAll() => WorkerSet.Shared.Run(_groupCount, maxThreads, this, static (copies, group) => copies.Update(group));

    /// <summary>True for a body that moves by itself, and gives way.</summary>
    public static bool CanMove(Body body) => !body.IsAsleep && !body.IsStuck && body.IsOverlapResolved;

    /// <summary>True for a body that searches for others that it touches.</summary>
    public static bool MaySearch(Body body) => CanMove(body) && (body.MayTouchBodies || body.IsCompound);

    /// <summary>How far from a body another one may be that touches it.</summary>
    public static double TouchDistanceOf(in GraphBody body) =>
        (body.HasHeapMargin ? ContactTolerances.HeapMargin * body.Radius : 0) + ContactTolerances.Slop(body.Radius, body.Position);

    /// <summary>How far a body may get from where its velocity leads.</summary>
    public static double DeviationLimit(in GraphBody body) => body.Slack + body.Push + body.KinematicPush;

    /// <summary>Velocity of the first body of a pair relative to the second.</summary>
    public Vector RelativeVelocity(in BodyPair pair) => pair.IsSecondImmovable
        ? _states[pair.First].Velocity : _states[pair.First].Velocity - _states[pair.Second].Velocity;

    /// <summary>True where a kinematic object pushes one of two bodies, or others do that it pushes.</summary>
    public bool IsPushed(in BodyPair pair) =>
        _states[pair.First].KinematicPush > 0 || (!pair.IsSecondImmovable && _states[pair.Second].KinematicPush > 0);

    private void SetGroups()
    {
        _bodiesPerGroup = Math.Max(MinBodiesOfGroup, (bodies.Count + MaxGroups - 1) / MaxGroups);
        _groupCount = (bodies.Count + _bodiesPerGroup - 1) / _bodiesPerGroup;
    }

    /// <summary>Copies a group of bodies as they are when their step begins.</summary>
    private void Copy(int index)
    {
        var group = _groups[index];
        var (first, end) = BodiesOf(index);
        group.HasSleeping = false;
        group.HasPushed = false;
        var bounds = GridBounds.None;
        for (var i = first; i < end; i++)
        {
            var body = bodies[i];
            group.HasPushed |= body.KinematicPush > 0;
            if (body.IsIdle && _idleCopies[i] == (body, body.SleepCount))
            {
                _states[i].IsTouching = false;
                _states[i].KinematicPush = body.KinematicPush;
                group.HasSleeping = true;
                bounds = bounds.With(_states[i].Position, _states[i].Radius);
                continue;
            }

            if (body.IsIdle || _idleCopies[i].Body is not null)
            {
                _idleCopies[i] = body.IsIdle ? (body, body.SleepCount) : default;
            }

            if (_descriptions[i] != body.Description)
            {
                _descriptions[i] = body.Description;
                _materials[i] = new(body.Description);
            }

            CopyState(body, ref _states[i]);
            group.HasSleeping |= body.IsAsleep;
            bounds = bounds.With(body.Position, body.Radius);
        }

        group.Bounds = bounds;
    }

    private void CopyState(Body body, ref GraphBody state)
    {
        var canMove = CanMove(body);
        var speedGain = canMove ? StepLength * body.FreeAcceleration.Length() : 0;
        state = new()
        {
            Position = body.Position,
            Radius = body.Radius,
            CanMove = canMove,
            MaySearch = MaySearch(body),
            IsCompound = body.IsCompound,
            IsIdle = body.IsIdle,
            HasHeapMargin = body.HasHeapMargin,
            Rounding = ContactTolerances.Slop(0, body.Position),
            Velocity = body.Velocity,
            SpeedGain = speedGain,
            Slack = (StepLength * speedGain) + (ReachMargin * body.Radius),
            KinematicPush = body.KinematicPush,
        };
        SetSearchDistance(ref state);
    }

    /// <summary>Copies what has changed of a group of bodies since then, and tells bodies whether they touch others.</summary>
    private void Update(int index)
    {
        var group = _groups[index];
        var (first, end) = BodiesOf(index);
        group.HasFaster = false;
        group.HasPushed = false;
        for (var i = first; i < end; i++)
        {
            ref var state = ref _states[i];
            if (state.IsIdle && !state.IsTouching && !(state.KinematicPush > 0))
            {
                state.Push = 0;
                state.HasLooked = false;
                group.HasFaster |= IsFaster(in state);
                continue;
            }

            var body = bodies[i];
            body.MayTouchBodies = state.IsTouching || (body.MayTouchBodies && body.IsAsleep);
            state.KinematicPush = body.KinematicPush;
            state.Velocity = body.Velocity;
            state.Reach = state.CanMove ? ReachOf(in state) : 0;
            state.Push = 0;
            state.HasLooked = false;
            group.HasFaster |= IsFaster(in state);
            group.HasPushed |= state.KinematicPush > 0;
        }
    }

    private double ReachOf(in GraphBody body) => (StepLength * body.Velocity.Length()) + body.Slack + body.KinematicPush;

    /// <summary>What a body may meet lies among the neighbours that it may touch, unless it is fast.</summary>
    private void SetSearchDistance(ref GraphBody body)
    {
        var reach = body.CanMove ? ReachOf(in body) : 0;
        var isFast = 2 * reach > MaxEarlyDistance * body.Radius;
        body.SearchReach = isFast ? 0 : reach;
        body.NearDistance = body.MaySearch ? Math.Max(TouchDistanceOf(in body), 2 * body.SearchReach) : double.NegativeInfinity;
    }

    /// <summary>True for a body that gets farther than the search for what touches has looked.</summary>
    public static bool IsFaster(in GraphBody body) => body.Reach > body.SearchReach || !body.MaySearch;

    /// <summary>What is known of a group of bodies.</summary>
    internal sealed class Group
    {
        /// <summary>True where some of the group may sleep.</summary>
        public bool HasSleeping { get; set; }

        /// <summary>True where some must look for what they may meet once more, since they are faster than was known.</summary>
        public bool HasFaster { get; set; }

        /// <summary>True where kinematic objects push some.</summary>
        public bool HasPushed { get; set; }

        /// <summary>The box of the group's centres, and its largest radius.</summary>
        public GridBounds Bounds { get; set; }
    }
}
