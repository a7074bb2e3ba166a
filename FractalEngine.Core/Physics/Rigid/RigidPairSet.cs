using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Statics;
using FractalEngine.Core.Threading;

namespace FractalEngine.Core.Physics.Rigid;

/// <summary>
/// The pairs of surfaces that may meet: finds them by their boxes (sort and sweep), keeps them, and shares out their searches.
/// </summary>
internal sealed class RigidPairSet
{
    /// <summary>Relative to the radius of the smaller body: the gap at which surfaces rest on each other.</summary>
    public const double ContactDistance = 1e-4;

    // Relative to the largest coordinate: the gap must be told from rounding.
    private const double MinContactDistance = 1e-11;

    // With fewer searches, waiting for other threads takes longer.
    private const int MinSharedSearches = 4;

    private readonly int _maxThreads;
    private readonly (ContactSearch Contacts, PairSweep Sweep)[] _searches;
    private readonly List<RigidPair> _due = [];
    private readonly List<RigidPair> _unused = [];
    private readonly List<(double Minimum, int Index)> _order = [];
    private readonly List<(int First, int Second)> _found = [];
    private List<RigidPair> _before = [];
    private List<RigidPair> _acted = [];
    private Action<RigidPair, ContactSearch, PairSweep>? _act;

    public RigidPairSet(int maxThreads)
    {
        _maxThreads = maxThreads;
        _searches = [.. Enumerable.Range(0, maxThreads).Select(static _ => (new ContactSearch(), new PairSweep()))];
    }

    /// <summary>The pairs, by their indices.</summary>
    public List<RigidPair> Pairs { get; private set; } = [];

    /// <summary>Forgets all pairs, with their contacts.</summary>
    public void Clear()
    {
        _unused.AddRange(Pairs);
        Pairs.Clear();
    }

    /// <summary>Forgets what is near, so that it is looked for anew.</summary>
    public void ForgetNear() => Pairs.ForEach(static pair => pair.ForgetNear());

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

    /// <summary>Finds the pairs whose boxes meet: a body that is awake with other bodies and objects.</summary>
    /// <param name="surfaces">All bodies, then all objects.</param>
    /// <param name="bodyCount">Number of bodies.</param>
    /// <param name="isStepBegun">True to keep what is known of the pairs that there are already.</param>
    public void Find(List<RigidSurface> surfaces, int bodyCount, bool isStepBegun)
    {
        _order.Clear();
        _found.Clear();
        for (var i = 0; i < bodyCount; i++)
        {
            _order.Add((surfaces[i].SweptBounds.Minimum.X, i));
        }

        _order.Sort(static (place1, place2) => place1.CompareTo(place2));
        for (var place = 0; place < bodyCount; place++)
        {
            var index = _order[place].Index;
            var surface = surfaces[index];
            var end = surface.SweptBounds.Maximum.X + (RigidPair.MaxGap * surface.Radius);
            for (var next = place + 1; next < bodyCount && _order[next].Minimum <= end; next++)
            {
                AddIfMeeting(surfaces, Math.Min(index, _order[next].Index), Math.Max(index, _order[next].Index));
            }

            for (var target = bodyCount; target < surfaces.Count; target++)
            {
                AddIfMeeting(surfaces, index, target);
            }
        }

        _found.Sort(static (pair1, pair2) => pair1.CompareTo(pair2));
        KeepPairs(surfaces, isStepBegun);
    }

    /// <summary>Finds the contacts of all pairs that are due.</summary>
    /// <param name="searched">Receives these pairs.</param>
    public void FindContacts(List<RigidPair> searched)
    {
        searched.Clear();
        foreach (var pair in Pairs)
        {
            if (pair.IsSearchDue)
            {
                searched.Add(pair);
            }
        }

        Run(searched, static (pair, contacts, _) => pair.FindContacts(contacts));
    }

    /// <summary>Finds which pairs come too close in the motions of a substep.</summary>
    public void FindImpacts() => Run(Pairs, static (pair, _, sweep) => pair.FindImpact(sweep));

    /// <summary>Does the same for pairs of which one has stopped since, in its other part.</summary>
    public void FindLaterImpacts()
    {
        _due.Clear();
        foreach (var pair in Pairs)
        {
            if (pair.IsSweepDue)
            {
                _due.Add(pair);
            }
        }

        Run(_due, static (pair, _, sweep) => pair.FindLaterImpact(sweep));
    }

    /// <summary>Finds a contact of two surfaces that stand still, where they touch or cross.</summary>
    /// <param name="first">The first surface.</param>
    /// <param name="motion1">Where it is.</param>
    /// <param name="second">The second surface.</param>
    /// <param name="motion2">Where it is, in the same frame.</param>
    /// <param name="distance">What is no farther apart touches.</param>
    /// <param name="point">Receives where.</param>
    public bool TryFindTouch(
        SurfaceNodes first, in SurfaceMotion motion1, SurfaceNodes second, in SurfaceMotion motion2, double distance, out Vector point)
    {
        var contacts = new List<ContactPoint>();
        _ = _searches[0].Contacts.FindContacts(first, in motion1, second, in motion2, distance, distance, contacts, [], []);
        point = contacts.Count > 0 ? contacts[0].Point : Vector.Zero;
        return contacts.Count > 0;
    }

    private void AddIfMeeting(List<RigidSurface> surfaces, int first, int second)
    {
        var (surface, other) = (surfaces[first], surfaces[second]);
        var body = surface.Body!;
        var canMeet = other.Body is { } otherBody
            ? Layers.CanMeet(body.Description.Layer, body.Description.Mask, otherBody.Description.Layer, otherBody.Description.Mask)
            : other.Target is { } target ? StaticObjectSet.CanMeet(target, body.Description.Layer, body.Description.Mask)
            : Layers.CanMeet(0, Layers.All, body.Description.Layer, body.Description.Mask);
        var radius = Math.Min(surface.Radius, other.Body?.Radius ?? double.PositiveInfinity);
        if (canMeet && (surface.IsAwake || other.IsAwake) && surface.GapTo(other) <= RigidPair.MaxGap * radius)
        {
            _found.Add((first, second));
        }
    }

    /// <summary>Makes the pairs that have been found, of those that there are already where it can.</summary>
    private void KeepPairs(List<RigidSurface> surfaces, bool isStepBegun)
    {
        (Pairs, _before) = (_before, Pairs);
        var before = 0;
        foreach (var (firstIndex, secondIndex) in _found)
        {
            var (first, second) = (surfaces[firstIndex], surfaces[secondIndex]);
            while (before < _before.Count && _before[before].Indices.CompareTo((firstIndex, secondIndex)) < 0)
            {
                _unused.Add(_before[before++]);
            }

            var isKnown = before < _before.Count && _before[before].First == first && _before[before].Second == second;
            var pair = isKnown ? _before[before++] : CreatePair();
            if (!isKnown)
            {
                pair.Set(firstIndex, first, secondIndex, second, Pairs.Count % _maxThreads);
            }

            if (!isStepBegun || !isKnown)
            {
                pair.BeginStep(Math.Max(ContactDistance * pair.Radius, MinContactDistance * first.Body!.Position.MaxAbsComponent()));
            }

            Pairs.Add(pair);
        }

        _unused.AddRange(CollectionsMarshal.AsSpan(_before)[before..]);
        _before.Clear();
    }

    private RigidPair CreatePair()
    {
        if (_unused.Count == 0)
        {
            return new();
        }

        var pair = _unused[^1];
        _unused.RemoveAt(_unused.Count - 1);
        return pair;
    }

    /// <summary>Does something with pairs, each by its own thread.</summary>
    private void Run(List<RigidPair> pairs, Action<RigidPair, ContactSearch, PairSweep> act)
    {
        if (pairs.Count < MinSharedSearches)
        {
            foreach (var pair in pairs)
            {
                act(pair, _searches[pair.Thread].Contacts, _searches[pair.Thread].Sweep);
            }

            return;
        }

        (_act, _acted) = (act, pairs);
        WorkerSet.Shared.Run(_maxThreads, _maxThreads, this, static (set, thread) =>
        {
            foreach (var pair in set._acted)
            {
                if (pair.Thread == thread)
                {
                    set._act!(pair, set._searches[thread].Contacts, set._searches[thread].Sweep);
                }
            }
        });
    }
}
