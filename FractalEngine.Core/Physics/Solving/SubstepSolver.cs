using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Islands;
using FractalEngine.Core.Physics.Rows;
using FractalEngine.Core.Threading;

namespace FractalEngine.Core.Physics.Solving;

/// <summary>
/// Finds how the bodies of an island move in a step, in a few substeps. Each adds what gravity and forces give, takes away what approaches,
/// moves all, and pushes apart what overlaps. A large island makes one round over its contacts in each; the next one goes on from there.
/// </summary>
/// <remarks>
/// Many small steps with few rounds beat few large ones with many rounds (Macklin et al. 2019, "Small steps in physics simulation"). Rounds
/// are projected Gauss–Seidel, forwards and backwards. Impulses take energy away, or leave it, up to what does not converge: that is taken
/// back at the end of the step. Pushes leave velocities as they are.
/// </remarks>
internal sealed class SubstepSolver(List<Body> bodies, ImpulseCache cache, int maxThreads)
{
    // Contacts from which on bodies may overlap by what can't be seen, so that the rounds suffice.
    private const int MinContactsOfLarge = 300;
    private const int Substeps = 3;
    private const int SubstepsOfSmall = 6;

    // A small island takes rounds until it has converged; one of many contacts as many as solve so many.
    private const int MaxRounds = 250;
    private const int ContactSolves = 20_000;
    private const int ContactSolvesOfLarge = 3000;

    // Relative to the largest impulse: a round that changes less has converged, and one that need not converge any further.
    private const double Tolerance = 1e-6;
    private const double FineTolerance = 1e-13;

    // Rounds that a few bodies need to converge as far as numbers go: more are for heaps, which nobody sees as far.
    private const int FineRounds = 16;

    // Relative to the momentum of a contact's bodies.
    private const double RelativeRounding = 1e-14;

    // Relative to the smaller radius: overlaps that stay, and overlaps at the end of a step beyond which more pushes are made.
    private const double Slop = 5e-4;
    private const double MaxOverlap = 0.03;

    // Rounds of pushes at the end of a step: as many as look at so many contacts.
    private const int MinPushes = 12;
    private const int MaxPushes = 40;
    private const int PushedContacts = 60_000;

    // What goes several radii in a step may end deep in others: more pushes, of so many contacts.
    private const double DeepOverlap = 0.15;
    private const int MaxDeepPushes = 200;
    private const int DeepPushedContacts = 600_000;

    // Relative to what gravity and forces add to the speed, and to the radius: less is what the rounds leave of it, and the ball rests.
    private const double RestFraction = 1e-10;

    // Part of an overlap that a push takes back: others push in again.
    private const double PushShare = 0.6;

    // Rounds over the planes that a ball must not end behind.
    private const int MaxPlaneRounds = 16;

    // Threads write zeros to what stands for surfaces that rest, one of each group, and so they are some lines of the cache apart.
    private const int SurfaceStride = 2;
    private const int RestingSurfaces = SurfaceStride * (IslandParts.MaxCount + 1);


    // The last group has the contacts between parts.
    private readonly Group[] _groups = [.. Enumerable.Range(0, IslandParts.MaxCount + 1).Select(static _ => new Group())];
    private BallState[] _states = [];
    private BallContact[] _contacts = [];
    private TurnFriction[] _turns = [];

    // Used where an island has compounds.
    private TurnedBody[] _turned = [];
    private ContactArms[] _arms = [];
    private double[] _impulses = [];
    private Vector256<double>[] _changes = [];
    private Vector256<double>[] _directions = [];
    private IslandSet? _islands;
    private Island _island;
    private double _stepLength;
    private double _substep;
    private double _share;
    private int _substepCount;
    private int _surfaceCount;
    private bool _isLarge;

    /// <summary>Rounds of the last solve.</summary>
    public int Rounds { get; private set; }

    /// <summary>True once bodies may end deep in others, so that they are looked at when all have moved.</summary>
    public bool HasDeepOverlaps { get; set; }

    private ReadOnlySpan<Group> Groups => _groups.AsSpan(0, _island.PartCount == 1 ? 1 : _island.PartCount + 1);

    private int FirstSurface => bodies.Count;

    /// <summary>Makes room for the bodies of a world and their contacts.</summary>
    public void Reserve(int bodyCount, int contactCount)
    {
        if (_states.Length < bodyCount + RestingSurfaces)
        {
            _states = new BallState[(2 * bodyCount) + RestingSurfaces];
        }

        if (_contacts.Length < contactCount)
        {
            _contacts = new BallContact[Math.Max(contactCount, 2 * _contacts.Length)];
            _turns = new TurnFriction[_contacts.Length];
            _impulses = new double[_contacts.Length];
            _changes = new Vector256<double>[_contacts.Length];
            _directions = new Vector256<double>[_contacts.Length];
        }

        if (bodies.Exists(static body => body.IsCompound) && (_turned.Length < _states.Length || _arms.Length < _contacts.Length))
        {
            _turned = new TurnedBody[_states.Length];
            _arms = new ContactArms[_contacts.Length];
        }
    }

    /// <summary>Impulse along the normal that a contact of the last island has had in the step.</summary>
    /// <param name="contact">Index among the contacts of the island.</param>
    public double ImpulseOf(int contact) => _impulses[contact];

    /// <summary>
    /// Finds the velocities and targets of the bodies of an island at the end of a step. None of the targets is behind a plane that one
    /// of their balls touches or may meet.
    /// </summary>
    /// <param name="islands">Has the contacts, which receive their last impulses.</param>
    /// <param name="island">The island.</param>
    /// <param name="stepLength">Seconds.</param>
    /// <param name="parts">Number of such steps that one is made in: so many fewer substeps are needed.</param>
    /// <returns>False for a small island that has not converged.</returns>
    public bool Solve(IslandSet islands, in Island island, double stepLength, int parts = 1)
    {
        SetIsland(islands, in island, stepLength, parts);
        Rounds = 0;
        WorkerSet.Shared.Run(island.PartCount, island.HasMovingSurface ? 1 : maxThreads, this, static (solver, part) => solver.Load(part));
        RunBetween(static (solver, part) => solver.Load(part));
        var isConverged = true;
        for (var i = 0; i < _substepCount; i++)
        {
            RunAll(static (solver, part) => solver.Accelerate(part));
            RunAll(static (solver, part) => solver.Begin(part));
            isConverged &= MakeRounds();
            RunAll(static (solver, part) => solver.Integrate(part));
        }

        PushApart();
        RunAll(static (solver, part) => solver.KeepInFront(part));
        RunAll(static (solver, part) => solver.Store(part));
        // Balls of compounds turn to where no contact is.
        HasDeepOverlaps |= island.HasCompound;
        foreach (var group in Groups)
        {
            HasDeepOverlaps |= group.Overlap > ContactTolerances.MaxOverlap;
        }

        return isConverged || _isLarge;
    }

    private void SetIsland(IslandSet islands, in Island island, double stepLength, int parts)
    {
        Reserve(bodies.Count, island.RowCount);
        _islands = islands;
        _island = island;
        _stepLength = stepLength;
        _isLarge = island.RowCount >= MinContactsOfLarge;
        _substepCount = Math.Max(1, (_isLarge ? Substeps : SubstepsOfSmall) / parts);
        _substep = stepLength / _substepCount;
        _surfaceCount = 0;
        Array.Clear(_states, FirstSurface, RestingSurfaces);
        var ends = islands.PartEndsOf(in island);
        var first = 0;
        for (var i = 0; i < Groups.Length; i++)
        {
            var end = ends.Length > 0 ? ends[i] : island.RowCount;
            (_groups[i].First, _groups[i].End) = (first, end);
            first = end;
        }
    }

    /// <summary>Does something for all parts, on all threads, and then for the contacts between them.</summary>
    private void RunAll(Action<SubstepSolver, int> act)
    {
        WorkerSet.Shared.Run(_island.PartCount, maxThreads, this, act);
        RunBetween(act);
    }

    private void RunBetween(Action<SubstepSolver, int> act)
    {
        if (_island.PartCount > 1)
        {
            act(this, _island.PartCount);
        }
    }

    private bool MakeRounds()
    {
        var maxRounds = Math.Clamp((_isLarge ? ContactSolvesOfLarge : ContactSolves) / Math.Max(1, _island.RowCount), 1, MaxRounds);
        var previousNorm = 0.0;
        for (var round = 1; ; round++)
        {
            Rounds++;
            RunAll(static (solver, part) => solver.SolveForwards(part));
            RunBetween(static (solver, part) => solver.SolveBackwards(part));
            WorkerSet.Shared.Run(_island.PartCount, maxThreads, this, static (solver, part) => solver.SolveBackwards(part));
            var (change, impulse, rounding, norm) = (0.0, 0.0, 0.0, 0.0);
            foreach (var group in Groups)
            {
                norm += group.Norm;
                change = Math.Max(change, group.Change);
                impulse = Math.Max(impulse, group.Impulse);
                rounding = Math.Max(rounding, group.Rounding);
            }

            var tolerance = round < FineRounds ? FineTolerance : Tolerance;
            if (round == maxRounds || change <= Math.Max(tolerance * impulse, rounding))
            {
                return change <= Math.Max(Tolerance * impulse, rounding);
            }

            // Directions that have not led to the end by now may never do so where balls begin and cease to slip.
            _share = previousNorm > 0 && norm <= previousNorm && round < maxRounds / 2 ? norm / previousNorm : 0;
            RunAll(static (solver, part) => solver.Extrapolate(part));
            previousNorm = norm;
        }
    }

    /// <summary>Pushes apart what still overlaps.</summary>
    private void PushApart()
    {
        var worst = double.PositiveInfinity;
        var maxPushes = Math.Clamp(PushedContacts / Math.Max(1, _island.RowCount), MinPushes, MaxPushes);
        var maxDeepPushes = Math.Clamp(DeepPushedContacts / Math.Max(1, _island.RowCount), MinPushes, MaxDeepPushes);
        for (var i = 0; worst > (i < maxPushes ? MaxOverlap : DeepOverlap) && i < maxDeepPushes; i++)
        {
            RunAll(static (solver, part) => solver.Push(part));
            worst = 0;
            foreach (var group in Groups)
            {
                worst = Math.Max(worst, group.Overlap);
            }
        }
    }

    private ReadOnlySpan<int> BodiesOf(int part) => part < _island.PartCount ? _islands!.BodiesOfPart(in _island, part) : [];

    private void Load(int index)
    {
        foreach (var body in BodiesOf(index))
        {
            _states[body] = new(bodies[body], _substep);
            if (_island.HasCompound)
            {
                _turned[body] = new(bodies[body]);
            }
        }

        var group = _groups[index];
        var rows = _islands!.RowsOf(in _island);
        var rounding = 0.0;
        for (var i = group.First; i < group.End; i++)
        {
            ref var row = ref rows[i];
            cache.Recall(ref row);
            var first = bodies[row.First];
            var other = row.Second >= 0 ? bodies[row.Second] : null;
            var (mass, inertia) = (1 / first.Description.Mass, first.InverseInertia);
            var spin = inertia * row.FirstRadius * row.FirstRadius;
            var velocity = first.VelocityAt(row.FirstArm);
            if (other is not null)
            {
                mass += 1 / other.Description.Mass;
                inertia += other.InverseInertia;
                spin += other.InverseInertia * row.SecondRadius * row.SecondRadius;
                velocity -= other.VelocityAt(row.SecondArm);
                var maxOverlap = ContactTolerances.MaxOverlap * Math.Min(row.FirstRadius, row.SecondRadius);
                if (Vector.Dot(row.Offset, row.Normal) < row.MinDistance - maxOverlap)
                {
                    (first.BeganDeep, other.BeganDeep) = (true, true);
                }
            }
            else if (row.IsOnMovingSurface)
            {
                velocity -= row.SurfaceVelocity;
            }

            var willBounce = row.IsAhead && row.Restitution > 0
                && -Vector.Dot(velocity, row.Normal) > Math.Max(first.RestitutionThreshold, other?.RestitutionThreshold ?? 0);
            var second = other is not null ? row.Second
                : row.IsOnMovingSurface ? AddSurface(in row) : FirstSurface + (SurfaceStride * index);
            _contacts[i] = new(in row, second, (mass, inertia, spin), willBounce, 1.0 / _substepCount);
            _impulses[i] = 0;
            rounding = Math.Max(rounding, first.Velocity.MaxAbsComponent() / mass);
            if (_contacts[i].SlowsTurns)
            {
                _turns[i] = new(in row, inertia, 1.0 / _substepCount);
            }

            if (row.HasArms)
            {
                _arms[i] = new(in row);
            }
        }

        group.Rounding = RelativeRounding * rounding;
    }

    private int AddSurface(in ContactRow row)
    {
        var index = FirstSurface + RestingSurfaces + _surfaceCount++;
        if (index == _states.Length)
        {
            Array.Resize(ref _states, 2 * _states.Length);
            Array.Resize(ref _turned, _turned.Length > 0 ? _states.Length : 0);
        }

        _states[index] = new(row.SurfaceVelocity, row.SurfaceSpin);
        return index;
    }

    private void Accelerate(int part)
    {
        foreach (var body in BodiesOf(part))
        {
            _states[body].Velocity += _states[body].Gain;
        }
    }

    private void Begin(int index)
    {
        var group = _groups[index];
        for (var i = group.First; i < group.End; i++)
        {
            ref var contact = ref _contacts[i];
            ref var first = ref _states[contact.First];
            ref var second = ref _states[contact.Second];
            var gap = contact.Place(ref first, ref second, PushShare, Slop);
            if (contact.HasArms)
            {
                _arms[i].Place(in contact, in first, in second, in _turned[contact.First], in _turned[contact.Second]);
            }

            contact.Begin(gap, _substep);
            if (contact.Impulse != Vector256<double>.Zero)
            {
                Apply(i, ref contact, contact.Impulse);
            }

            if (contact.SlowsTurns)
            {
                ApplyTurn(in contact, _turns[i].Impulse);
            }
        }
    }

    private void Apply(int index, ref BallContact contact, Vector256<double> impulse)
    {
        ref var first = ref _states[contact.First];
        ref var second = ref _states[contact.Second];
        if (contact.HasArms)
        {
            _arms[index].Apply(
                ref first, ref second, in _turned[contact.First], in _turned[contact.Second], contact.Push(impulse));
        }
        else
        {
            contact.Apply(ref first, ref second, impulse);
        }
    }

    private void ApplyTurn(in BallContact contact, Vector256<double> turn)
    {
        _states[contact.First].Spin += SpinChange(contact.First, turn);
        _states[contact.Second].Spin -= SpinChange(contact.Second, turn);
    }

    private Vector256<double> SpinChange(int index, Vector256<double> turn) => _island.HasCompound
        ? SimdAffineMap.ToVector256(_turned[index].InverseInertia * SimdAffineMap.ToVector(turn))
        : Vector256.Create(_states[index].InverseInertia) * turn;

    private Vector256<double> SolveArms(int index, ref BallContact contact) => _arms[index].Solve(ref contact,
        ref _states[contact.First], ref _states[contact.Second], in _turned[contact.First], in _turned[contact.Second]);

    private Vector256<double> StopTurning(int index, in BallContact contact)
    {
        var turn = _turns[index].Solve(in contact, in _states[contact.First], in _states[contact.Second]);
        ApplyTurn(in contact, turn);
        return turn;
    }

    private void SolveForwards(int index)
    {
        var group = _groups[index];
        for (var i = group.First; i < group.End; i++)
        {
            ref var contact = ref _contacts[i];
            _changes[i] = contact.HasArms ? SolveArms(i, ref contact)
                : contact.Solve(ref _states[contact.First], ref _states[contact.Second]);
            if (contact.SlowsTurns)
            {
                _ = StopTurning(i, in contact);
            }
        }
    }

    private void SolveBackwards(int index)
    {
        var group = _groups[index];
        var change = Vector256<double>.Zero;
        var (impulse, norm) = (0.0, 0.0);
        for (var i = group.End - 1; i >= group.First; i--)
        {
            ref var contact = ref _contacts[i];
            _changes[i] += contact.HasArms ? SolveArms(i, ref contact)
                : contact.Solve(ref _states[contact.First], ref _states[contact.Second]);
            change = Vector256.MaxNative(change, Vector256.Abs(_changes[i]));
            norm += contact.NormOf(_changes[i]);
            impulse = Math.Max(impulse, contact.NormalImpulse);
            if (contact.SlowsTurns)
            {
                var turn = StopTurning(i, in contact);
                change = Vector256.MaxNative(change, Vector256.Abs(turn) / Vector256.Create(contact.SmallerRadius));
            }
        }

        group.Change = Math.Max(Math.Max(change[0], change[1]), Math.Max(change[2], change[3]));
        group.Impulse = impulse;
        group.Norm = norm;
    }

    /// <summary>Goes on along the changes of the rounds so far: a nonlinear conjugate gradient method (Silcowitz et al. 2010).</summary>
    private void Extrapolate(int index)
    {
        var group = _groups[index];
        for (var i = group.First; i < group.End; i++)
        {
            ref var contact = ref _contacts[i];
            if (_share > 0)
            {
                var direction = Vector256.Create(_share) * _directions[i];
                contact.Impulse += direction;
                Apply(i, ref contact, direction);
                _directions[i] = direction + _changes[i];
            }
            else
            {
                _directions[i] = _changes[i];
            }
        }
    }

    private void Integrate(int index)
    {
        var group = _groups[index];
        for (var i = group.First; i < group.End; i++)
        {
            _impulses[i] += _contacts[i].NormalImpulse;
        }

        var time = Vector256.Create(_substep);
        foreach (var body in BodiesOf(index))
        {
            ref var state = ref _states[body];
            state.Displacement += time * state.Velocity;
            if (bodies[body].IsCompound)
            {
                state.Spin = SimdAffineMap.ToVector256(_turned[body].Advance(SimdAffineMap.ToVector(state.Spin), _substep));
            }
        }

        for (var i = group.First; _island.HasCompound && i < group.End; i++)
        {
            ref var contact = ref _contacts[i];
            if (contact.HasArms)
            {
                _arms[i].Turn(ref contact, in _turned[contact.First], in _turned[contact.Second]);
            }
        }

        for (var i = 0; index == 0 && i < _surfaceCount; i++)
        {
            ref var surface = ref _states[FirstSurface + RestingSurfaces + i];
            surface.Displacement += time * surface.Velocity;
        }
    }

    /// <summary>Pushes apart what overlaps, and finds the largest overlap before, relative to the smaller radius.</summary>
    private void Push(int index)
    {
        var group = _groups[index];
        group.Overlap = 0;
        for (var i = group.First; i < group.End; i++)
        {
            ref var contact = ref _contacts[i];
            var gap = contact.Place(ref _states[contact.First], ref _states[contact.Second], PushShare, Slop);
            group.Overlap = Math.Max(group.Overlap, -gap / contact.SmallerRadius);
        }
    }

    /// <summary>Ends all ways before the planes of surfaces, which are the first contacts of a part and give way to nothing.</summary>
    private void KeepInFront(int index)
    {
        var group = _groups[index];
        var isMoved = true;
        for (var round = 0; round < MaxPlaneRounds && isMoved; round++)
        {
            isMoved = false;
            for (var i = group.First; i < group.End && !_contacts[i].IsBall; i++)
            {
                ref var contact = ref _contacts[i];
                isMoved |= contact.Place(ref _states[contact.First], ref _states[contact.Second], share: 1, slop: 0) < 0;
            }
        }
    }

    private void Store(int index)
    {
        var group = _groups[index];
        group.Overlap = 0;
        foreach (var i in BodiesOf(index))
        {
            ref readonly var state = ref _states[i];
            var body = bodies[i];
            var (velocity, spin) = (SimdAffineMap.ToVector(state.Velocity), SimdAffineMap.ToVector(state.Spin));
            var displacement = SimdAffineMap.ToVector(state.Displacement);
            group.Overlap = _islands!.Graph.HasDeviated(i, displacement) ? double.PositiveInfinity : group.Overlap;
            var negligible = RestFraction * _stepLength * body.FreeAcceleration.Length();
            if (Math.Max(velocity.MaxAbsComponent(), body.Velocity.MaxAbsComponent()) <= negligible
                && spin.MaxAbsComponent() * body.Radius <= negligible && displacement.MaxAbsComponent() <= RestFraction * body.Radius)
            {
                (velocity, spin, displacement) = (Vector.Zero, Vector.Zero, Vector.Zero);
            }
            else if (IsInFlight(in state, body))
            {
                displacement = _stepLength * (body.Velocity + (0.5 * _stepLength * body.FreeAcceleration));
            }

            body.PlannedStart = body.Position;
            body.PlannedStartEnergy = body.KineticEnergy;
            (body.PlannedChange, body.PlannedSpinChange) = (Vector.Zero, Vector.Zero);
            body.Velocity = velocity;
            body.AngularVelocity = spin;
            if (body.IsCompound)
            {
                body.PlannedTurn = spin == Vector.Zero && displacement == Vector.Zero ? Vector.Zero : _turned[i].RotationVector;
            }

            body.Target = body.Position + displacement;
            body.IsHeld = false;
        }

        var rows = _islands!.RowsOf(in _island);
        for (var i = group.First; i < group.End; i++)
        {
            ref readonly var contact = ref _contacts[i];
            var gap = contact.GapOf(in _states[contact.First], in _states[contact.Second]);
            group.Overlap = Math.Max(group.Overlap, -gap / contact.SmallerRadius);
            rows[i].NormalImpulse = _substepCount * _contacts[i].NormalImpulse;
            rows[i].FrictionImpulse = _substepCount * _contacts[i].FrictionImpulse;
            rows[i].TurnImpulse = _contacts[i].SlowsTurns ? _substepCount * SimdAffineMap.ToVector(_turns[i].Impulse) : Vector.Zero;
        }
    }

    /// <summary>True where no contact has changed a velocity or a way: such a ball follows its parabola.</summary>
    private bool IsInFlight(in BallState state, Body body)
    {
        var velocity = SimdAffineMap.ToVector256(body.Velocity);
        var displacement = Vector256<double>.Zero;
        for (var i = 0; i < _substepCount; i++)
        {
            velocity += state.Gain;
            displacement += Vector256.Create(_substep) * velocity;
        }

        return velocity == state.Velocity && displacement == state.Displacement;
    }

    /// <summary>The contacts within one part of an island, or between its parts.</summary>
    private sealed class Group
    {
        public int First { get; set; }

        public int End { get; set; }

        public double Change { get; set; }

        public double Impulse { get; set; }

        public double Rounding { get; set; }

        public double Norm { get; set; }

        public double Overlap { get; set; }
    }
}
