using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Rigid;

/// <summary>
/// Two surfaces that may meet in a step: the contacts between them, all that is near, and how far they may have come closer since that was
/// found.
/// </summary>
internal sealed class RigidPair
{
    /// <summary>How far surfaces may be apart whose contacts are known before they touch, in radii of the smaller one.</summary>
    public const double MaxGap = 0.02;

    // Relative to the contact distance: no closer does a sweep let surfaces come.
    private const double SweepDistance = 0.25;

    // The same for the least such gap, in contact distances, and how much more is looked for than the surfaces may come closer in a step.
    private const double MinMargin = 4;
    private const double MarginFactor = 1.25;

    // Relative to the contact distance: contacts are kept from step to step while the surfaces have come no closer, or moved no farther.
    private const double MaxKeptWay = 0.25;

    // Relative to the radius: how far bodies that begin within each other are moved apart in a substep.
    private const double PartingWay = 0.02;

    private readonly List<NearPair> _near = [];
    private readonly List<(int First, int Second)> _leaves = [];
    private ContactPoint? _hit;
    private ContactPoint? _sweptHit;
    private bool _isParting;
    private double _margin;
    private double _way;
    private double _substepWay;
    private (double First, double Second) _swept;

    /// <summary>The first surface, that of a body.</summary>
    public RigidSurface First { get; private set; } = null!;

    /// <summary>The second surface, of whatever it is.</summary>
    public RigidSurface Second { get; private set; } = null!;

    /// <summary>Index of the first one's state.</summary>
    public int FirstIndex { get; private set; }

    /// <summary>Index of the second one's state.</summary>
    public int SecondIndex { get; private set; }

    /// <summary>
    /// True for what does not stop each other: where one carries the other, or a third one both, nothing comes closer; and bodies that
    /// begin within each other come free first.
    /// </summary>
    private bool IsFree => _isParting || (First.Carrier is not null && First.Carrier == Second.Carrier);

    /// <summary>What is met, of the first and the second, by the other one that moves by itself or is carried; null for none.</summary>
    public (RigidSurface Met, int Index, RigidSurface Carrier)? Push => (First.Carrier, Second.Carrier) switch
    {
        (null, { } carrier) => (First, FirstIndex, carrier),
        ({ } carrier, null) when Second.Body is not null => (Second, SecondIndex, carrier),
        _ => null,
    };

    /// <summary>The indices of both states.</summary>
    public (int First, int Second) Indices => (FirstIndex, SecondIndex);

    /// <summary>Index of the searches and trees that look at the pair.</summary>
    public int Thread { get; private set; }

    /// <summary>Radius of the smaller body, scene units.</summary>
    public double Radius { get; private set; }

    /// <summary>The distance at which they rest on each other, scene units.</summary>
    public double Distance { get; private set; }

    /// <summary>The contacts that the last search found, relative to the first one's origin then.</summary>
    public List<ContactPoint> Contacts { get; } = [];

    /// <summary>The contacts as the solver left them.</summary>
    public List<RigidRow> Rows { get; } = [];

    /// <summary>True where what is near has to be looked for before the next substep.</summary>
    public bool IsSearchDue { get; private set; }

    /// <summary>The part of the substep after which they would be too close, from 0 to 1.</summary>
    public double Impact { get; private set; }

    /// <summary>The earliest of all such parts that have been found in the substep.</summary>
    public double FirstImpact { get; private set; }

    /// <summary>Begins a pair of which nothing is known.</summary>
    public void Set(int firstIndex, RigidSurface first, int secondIndex, RigidSurface second, int thread)
    {
        (FirstIndex, First, SecondIndex, Second, Thread) = (firstIndex, first, secondIndex, second, thread);
        Radius = Math.Min(first.Radius, second.Body?.Radius ?? double.PositiveInfinity);
        Contacts.Clear();
        Rows.Clear();
        _hit = null;
        _isParting = false;
        ForgetNear();
    }

    /// <summary>Begins a step. What was found in the last one counts while the two have barely moved, or what is near is known.</summary>
    /// <param name="distance">The distance at which the surfaces rest on each other, scene units.</param>
    public void BeginStep(double distance)
    {
        IsSearchDue |= First.IsMovedByOthers || Second.IsMovedByOthers || distance != Distance
            || (Contacts.Count > 0 && _way > MaxKeptWay * distance);
        Distance = distance;
    }

    /// <summary>Forgets what is near, so that it is looked for anew.</summary>
    public void ForgetNear()
    {
        _leaves.Clear();
        IsSearchDue = true;
    }

    /// <summary>Finds the contacts, and all that may meet in the motions that the surfaces have now.</summary>
    public void FindContacts(ContactSearch search)
    {
        var (motion1, motion2) = RelativeMotions(First.Motion, Second.Motion);
        var way = Math.Clamp(MarginFactor * MaxWay(in motion1, in motion2), MinMargin * Distance, MaxGap * Radius);
        var margin = (2 * Distance) + way;
        Contacts.Clear();
        _near.Clear();
        _margin = search.FindContacts(
            First.Shape.NodesOf(Thread), in motion1, Second.Shape.NodesOf(Thread), in motion2, Distance, margin, Contacts, _near, _leaves);
        _way = 0;
        IsSearchDue = false;
        // What stopped them is a contact, whatever the search makes of it.
        if (_hit is { } hit)
        {
            Contacts.Add(hit with { Point = hit.Point - First.Motion.Origin });
            _hit = null;
        }

        _isParting = search.HasCrossed && Second.Body is not null;
        if (_isParting)
        {
            // Whatever crosses has begun so, and no normal of a face tells the way out.
            var between = motion1.Position - motion2.Position;
            Contacts.Clear();
            Contacts.Add(new(-0.5 * between, between != Vector.Zero ? between.UnitVector() : Vector.J, -PartingWay * Radius));
        }
    }

    /// <summary>Finds when the surfaces come too close in a substep of which both make the whole motion.</summary>
    public void FindImpact(PairSweep sweep)
    {
        Impact = 1;
        _swept = (1, 1);
        var (motion1, motion2) = RelativeMotions(First.Motion, Second.Motion);
        _substepWay = MaxWay(in motion1, in motion2);
        Impact = IsFree ? 1 : Math.Min(Impact, Sweep(sweep, in motion1, in motion2, 1));
        FirstImpact = Impact;
    }

    /// <summary>Finds the same where one of them has stopped and the other one goes on.</summary>
    public void FindLaterImpact(PairSweep sweep)
    {
        Impact = 1;
        _swept = (First.Fraction, Second.Fraction);
        var begin = Math.Min(First.Fraction, Second.Fraction);
        var duration = Math.Max(First.Fraction, Second.Fraction) - begin;
        var (motion1, motion2) = RelativeMotions(First.Motion, Second.Motion);
        var wayBefore = begin * MaxWay(in motion1, in motion2);
        (motion1, motion2) = RelativeMotions(First.MotionAfter(begin), Second.MotionAfter(begin));
        _substepWay = wayBefore + (duration * MaxWay(in motion1, in motion2));
        var impact = Sweep(sweep, in motion1, in motion2, duration);
        Impact = impact < duration ? begin + impact : 1;
        FirstImpact = Math.Min(FirstImpact, Impact);
    }

    /// <summary>True where one has stopped since the last sweep, and the other one goes on.</summary>
    public bool IsSweepDue => !IsFree && _swept != (First.Fraction, Second.Fraction) && First.Fraction != Second.Fraction
        && (First.Fraction < Second.Fraction ? Second : First).Motion.IsMoving;

    /// <summary>Ends a substep. What is near is looked for anew where the two have met, or may have come too close.</summary>
    public void EndSubstep()
    {
        _way += _substepWay;
        var isUsedUp = _margin > 0 && _way + _substepWay > _margin - (2 * Distance) && _substepWay < MaxGap * Radius;
        IsSearchDue = Impact < 1 || isUsedUp || _isParting;
        _hit = Impact < 1 && Math.Min(First.Fraction, Second.Fraction) >= Impact ? _sweptHit : null;
    }

    private double Sweep(PairSweep sweep, in SurfaceMotion motion1, in SurfaceMotion motion2, double duration)
    {
        var distance = SweepDistance * Distance;
        var way = _way + _substepWay;
        // What was looked at for contacts is all that may meet, unless both come closer than was thought then.
        var impact = sweep.FindImpact(
            First.Shape.NodesOf(Thread), in motion1, Second.Shape.NodesOf(Thread), in motion2, distance, duration,
            way <= _margin - (2 * distance) ? _near : null, way + (2 * distance));
        _sweptHit = sweep.Hit is { } hit ? hit with { Point = hit.Point + First.Motion.Origin } : null;
        return impact;
    }

    private (SurfaceMotion First, SurfaceMotion Second) RelativeMotions(in SurfaceMotion first, in SurfaceMotion second) =>
        (first.RelativeTo(First.Motion.Origin), second.RelativeTo(First.Motion.Origin));

    /// <summary>How far points of the two surfaces may come closer in a unit of time at most.</summary>
    private double MaxWay(in SurfaceMotion motion1, in SurfaceMotion motion2)
    {
        var way = (motion1.Travel - motion2.Travel).Length() + (motion1.Angle * (First.Radius + motion1.Arm.Length()));
        var radius = Second.Body?.Radius ?? First.Radius + (motion2.Origin - motion1.Origin).Length();
        return way + (motion2.Angle * (radius + motion2.Arm.Length()));
    }
}
