using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Rigid;

/// <summary>
/// The contacts of two surfaces, reduced to few that hold as well: of each group with about the same normal the deepest one, and the
/// outermost one in each of eight directions across it.
/// </summary>
internal sealed class ContactManifold
{
    private const int MaxGroups = 12;
    private const int Directions = 8;
    private const int PointsPerGroup = Directions + 1;

    // Cosine of the angle between normals of one group.
    private const double MinCosine = 0.995;

    // Relative to the contact distance: what counts as no deeper.
    private const double GapTolerance = 0.25;

    // The same for what counts as no farther out than the outermost contacts: a hundredth of the radius.
    private const double OutwardTolerance = 100;

    // Relative to the contact distance: points that count as one place, or as no farther out.
    private const double PlaceTolerance = 1;

    // Angle of the first direction, in which no common shape has two outermost corners.
    private const double FirstAngle = 0.29;

    private readonly ContactPoint[] _points = new ContactPoint[MaxGroups * PointsPerGroup];
    private readonly Vector[] _normals = new Vector[MaxGroups];
    private readonly Vector[] _directions = new Vector[MaxGroups * Directions];
    private double _distance;
    private int _groupCount;

    /// <summary>Begins the contacts of another pair.</summary>
    /// <param name="distance">The distance at which surfaces rest on each other, scene units.</param>
    public void Begin(double distance)
    {
        _distance = distance;
        _groupCount = 0;
    }

    /// <summary>Number of times that a contact has changed what is kept.</summary>
    public int ChangeCount { get; private set; }

    /// <summary>Adds a contact, if it is deeper or farther out than others of its group.</summary>
    public void Add(in ContactPoint contact)
    {
        var group = FindGroup(contact.Normal);
        if (group < 0)
        {
            if (_groupCount == MaxGroups)
            {
                return;
            }

            group = CreateGroup(contact.Normal);
            ChangeCount++;
            Array.Fill(_points, contact, group * PointsPerGroup, PointsPerGroup);
            return;
        }

        var points = _points.AsSpan(group * PointsPerGroup, PointsPerGroup);
        if (contact.Gap < points[Directions].Gap)
        {
            points[Directions] = contact;
            ChangeCount++;
        }

        for (var i = 0; i < Directions; i++)
        {
            var farther = Vector.Dot(_directions[(group * Directions) + i], contact.Point - points[i].Point);
            if (farther > PlaceTolerance * _distance)
            {
                points[i] = contact;
                ChangeCount++;
            }
        }
    }

    /// <summary>
    /// True where contacts between two boxes would change nothing: the boxes are apart along the normal of a group, by no less than its
    /// deepest contact, and the smaller one reaches no farther out than its outermost ones.
    /// </summary>
    /// <param name="first">Box around a part of the first surface.</param>
    /// <param name="second">Box around a part of the second surface.</param>
    public bool Holds(in SurfaceBox first, in SurfaceBox second)
    {
        ref readonly var smaller = ref first.Radius < second.Radius ? ref first : ref second;
        for (var group = 0; group < _groupCount; group++)
        {
            var normal = _normals[group];
            var gap = Vector.Dot(normal, first.Centre - second.Centre) - first.Extent(normal) - second.Extent(normal);
            var deepest = _points[(group * PointsPerGroup) + Directions].Gap;
            if (gap > 0 && gap > deepest - (GapTolerance * _distance) && IsWithin(group, in smaller))
            {
                return true;
            }
        }

        return false;
    }

    /// <summary>Lists the contacts, each once.</summary>
    public void CopyTo(List<ContactPoint> contacts)
    {
        for (var group = 0; group < _groupCount; group++)
        {
            var first = contacts.Count;
            var points = _points.AsSpan(group * PointsPerGroup, PointsPerGroup);
            for (var i = PointsPerGroup - 1; i >= 0; i--)
            {
                if (!IsListed(contacts, first, points[i].Point))
                {
                    contacts.Add(points[i]);
                }
            }
        }
    }

    private bool IsListed(List<ContactPoint> contacts, int first, Vector point)
    {
        for (var i = first; i < contacts.Count; i++)
        {
            if ((contacts[i].Point - point).Length() <= PlaceTolerance * _distance)
            {
                return true;
            }
        }

        return false;
    }

    /// <summary>True for a box that is no farther out in any direction than a group's outermost points.</summary>
    private bool IsWithin(int group, in SurfaceBox box)
    {
        for (var i = 0; i < Directions; i++)
        {
            var direction = _directions[(group * Directions) + i];
            var point = _points[(group * PointsPerGroup) + i].Point;
            if (Vector.Dot(direction, box.Centre - point) + box.Extent(direction) > OutwardTolerance * _distance)
            {
                return false;
            }
        }

        return true;
    }

    private int FindGroup(Vector normal)
    {
        for (var group = 0; group < _groupCount; group++)
        {
            if (Vector.Dot(normal, _normals[group]) > MinCosine)
            {
                return group;
            }
        }

        return -1;
    }

    private int CreateGroup(Vector normal)
    {
        var group = _groupCount++;
        _normals[group] = normal;
        var tangent1 = normal.Perpendicular();
        var tangent2 = Vector.Cross(normal, tangent1);
        for (var i = 0; i < Directions; i++)
        {
            var (sine, cosine) = Math.SinCos(FirstAngle + (2 * Math.PI * i / Directions));
            _directions[(group * Directions) + i] = (cosine * tangent1) + (sine * tangent2);
        }

        return group;
    }
}
