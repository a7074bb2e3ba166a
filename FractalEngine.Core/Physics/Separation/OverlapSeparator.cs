using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Islands;
using FractalEngine.Core.Physics.Rows;
using FractalEngine.Core.Threading;

namespace FractalEngine.Core.Physics.Separation;

/// <summary>
/// Takes back the overlaps that the solve of an island has left, by displacements alone: one contact after the other, and again, until
/// all of them are negligible. The parts of a large island are separated on all threads, and then the contacts between them.
/// </summary>
internal sealed class OverlapSeparator
{
    /// <summary>Relative to the smaller radius: overlaps that are left.</summary>
    public const double NegligibleOverlap = 3e-7;

    // Rounds over the contacts that are near touching, and times that these are chosen anew.
    private const int MaxRounds = 60;
    private const int MaxChoices = 4;

    private readonly ContactGraph _graph;
    private readonly int _maxThreads;
    private readonly Action<int> _choose;
    private readonly Action<int> _separate;
    private readonly Action<int> _takeBackSurfaces;

    // One for each part, and behind them one for the contacts between parts.
    private readonly GapGroup[] _groups = [.. Enumerable.Range(0, IslandParts.MaxCount + 1).Select(static _ => new GapGroup())];
    private DisplacedBody[] _movers = [];
    private Island _island;
    private SeparationSettings _aim;
    private double _reach;
    private bool _isFirstRound;

    public OverlapSeparator(ContactGraph graph, int maxThreads)
    {
        _graph = graph;
        _maxThreads = maxThreads;
        _choose = Choose;
        _separate = SeparatePart;
        _takeBackSurfaces = TakeBackSurfaces;
    }

    private GapGroup Between => _groups[_island.PartCount];

    /// <summary>Makes room for the bodies of a world and their contacts.</summary>
    public void Reserve(int bodyCount, int contactCount)
    {
        _movers = new DisplacedBody[bodyCount];
        for (var i = 0; i < _groups.Length; i++)
        {
            // An island has so many parts at least where it has this one.
            _groups[i].Reserve(bodyCount, contactCount / (i + 1));
        }
    }

    /// <summary>Sets the displacement of a body from the beginning of the step, and its inverse mass; 0 where it is held.</summary>
    public void SetBody(int index, Vector displacement, double inverseMass) =>
        _movers[index] = new() { Displacement = displacement, ChosenDisplacement = displacement, InverseMass = inverseMass };

    /// <summary>The displacement of a body after the separation.</summary>
    public Vector DisplacementOf(int index) => _movers[index].Displacement;

    /// <summary>True for a body whose displacement has been changed.</summary>
    public bool HasMoved(int index) => _movers[index].HasMoved;

    /// <summary>Separates all bodies of an island, whose displacements must have been set.</summary>
    /// <param name="island">The island. Balls of a large one keep a margin, see <see cref="ContactTolerances.HeapMargin"/>.</param>
    /// <param name="others">Contacts that no plan knew.</param>
    public void Separate(in Island island, ReadOnlySpan<ContactRow> others)
    {
        _island = island;
        _aim = SeparationSettings.Of(in island);
        _reach = 0.5 * _aim.MaxGap * _graph.MinRadiusOf(in island);
        // Chosen anew as long as what was not near touching comes to overlap.
        var hasMoved = true;
        for (var choice = 0; choice < MaxChoices && hasMoved; choice++)
        {
            ChooseAll(others);
            var isEnded = false;
            hasMoved = island.PartCount == 1 ? SeparateWhole(out isEnded) : SeparateParts(out isEnded);
            hasMoved = hasMoved && !(StaysWithinReach(in island) && isEnded);
        }

        // Last, since what is immovable gives way to nothing.
        WorkerSet.Shared.Run(island.PartCount, _maxThreads, _takeBackSurfaces);
        for (var i = 0; i < others.Length; i++)
        {
            TakeBackSurfaces(others.Slice(i, 1));
        }
    }

    /// <summary>Chooses the contacts that are near touching.</summary>
    private void ChooseAll(ReadOnlySpan<ContactRow> others)
    {
        foreach (var group in _groups.AsSpan(0, _island.PartCount + 1))
        {
            group.Clear();
        }

        WorkerSet.Shared.Run(ContactGraph.GroupCountOf(in _island), _maxThreads, _choose);
        for (var i = 0; i < others.Length; i++)
        {
            _groups[GroupOf(in others[i])].AddNear(others.Slice(i, 1), _movers, in _aim);
        }

        if (_island.PartCount > 1)
        {
            // What moves across a cut lets the contacts within its part wait, if it has some.
            foreach (ref readonly var gap in Between.Gaps)
            {
                _groups[_graph.PartOf(gap.First)].ClearListOf(gap.First);
                _groups[_graph.PartOf(gap.Second)].ClearListOf(gap.Second);
            }

            Between.Enqueue(_movers.Length);
        }

        _isFirstRound = true;
    }

    /// <summary>True where no body has been moved so far that contacts come to overlap which were not near when they were chosen.</summary>
    private bool StaysWithinReach(in Island island)
    {
        var maxShiftSquared = 0.0;
        foreach (var index in _graph.BodiesOf(in island))
        {
            ref var mover = ref _movers[index];
            if (mover.HasMoved)
            {
                maxShiftSquared = Math.Max(maxShiftSquared, (mover.Displacement - mover.ChosenDisplacement).LengthSquared());
                mover.ChosenDisplacement = mover.Displacement;
            }
        }

        // Each of the two bodies may have come nearer by so much.
        return maxShiftSquared < _reach * _reach;
    }

    private int GroupOf(in ContactRow row)
    {
        if (_island.PartCount == 1)
        {
            return 0;
        }

        var part = _graph.PartOf(row.First);
        return row.Second < 0 || _graph.PartOf(row.Second) == part ? part : _island.PartCount;
    }

    private void Choose(int group) => _groups[group].AddNear(_graph.RowsOfPart(in _island, group), _movers, in _aim);

    /// <summary>Makes rounds to and fro: what the floor pushes up reaches the top of a pile in one round.</summary>
    /// <param name="isEnded">Receives true where none overlap any more that are near.</param>
    /// <returns>True where a body has been moved.</returns>
    private bool SeparateWhole(out bool isEnded)
    {
        _groups[0].Enqueue(_movers.Length);
        var hasMoved = _groups[0].MakeRound(_movers, isBackwards: false);
        isEnded = !hasMoved;
        for (var round = 1; round < MaxRounds && !isEnded; round++)
        {
            isEnded = !_groups[0].MakeRound(_movers, isBackwards: round % 2 == 1);
        }

        return hasMoved;
    }

    /// <summary>Makes rounds to and fro within each part, and then across the cuts.</summary>
    /// <inheritdoc cref="SeparateWhole"/>
    private bool SeparateParts(out bool isEnded)
    {
        var hasMoved = false;
        var isMoving = true;
        for (var round = 0; round < MaxRounds && isMoving; round += 2)
        {
            WorkerSet.Shared.Run(_island.PartCount, _maxThreads, _separate);
            _isFirstRound = false;
            isMoving = SeparateBetween();
            foreach (var group in _groups.AsSpan(0, _island.PartCount))
            {
                isMoving |= group.HasMoved;
            }

            hasMoved |= isMoving;
        }

        isEnded = !isMoving;
        return hasMoved;
    }

    private void SeparatePart(int part)
    {
        var group = _groups[part];
        if (_isFirstRound)
        {
            group.Enqueue(_movers.Length);
        }

        group.HasMoved = false;
        if (group.MakeRound(_movers, isBackwards: false))
        {
            _ = group.MakeRound(_movers, isBackwards: true);
        }
    }

    private bool SeparateBetween()
    {
        var group = Between;
        group.HasMoved = false;
        foreach (ref readonly var gap in group.Gaps)
        {
            PassOn(gap.First, group);
            PassOn(gap.Second, group);
        }

        if (group.MakeRound(_movers, isBackwards: false))
        {
            _ = group.MakeRound(_movers, isBackwards: true);
        }

        foreach (ref readonly var gap in group.Gaps)
        {
            PassOn(gap.First, _groups[_graph.PartOf(gap.First)]);
            PassOn(gap.Second, _groups[_graph.PartOf(gap.Second)]);
        }

        return group.HasMoved;
    }

    /// <summary>Lets the contacts of a body wait that has just been moved by those of another group.</summary>
    private void PassOn(int body, GapGroup group)
    {
        if (_movers[body].HasJustMoved)
        {
            _movers[body].HasJustMoved = false;
            group.WaitForContactsOf(body);
        }
    }

    private void TakeBackSurfaces(int part) => TakeBackSurfaces(_graph.RowsOfPart(in _island, part));

    private void TakeBackSurfaces(ReadOnlySpan<ContactRow> rows)
    {
        foreach (ref readonly var row in rows)
        {
            if (row.IsBall)
            {
                // Surfaces are first in each part.
                return;
            }

            _ = GapGroup.TakeBack(new SeparationGap(in row, in _aim), _movers);
        }
    }
}
