//! The packages of others come from where, under a licence and in the versions that `deny.toml` allows.

#![allow(clippy::expect_used, reason = "a failed expectation is a failed test")]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;

use cargo_metadata::{MetadataCommand, Package, PackageId};
use serde::Deserialize;
use spdx::{Expression, LicenseItem, ParseMode};

/// As much of the file as the tests below ask for.
#[derive(Deserialize)]
struct Rules {
    graph: Graph,
    licenses: Licenses,
    sources: Sources,
    bans: Bans,
}

#[derive(Deserialize)]
struct Graph {
    targets: Vec<String>,
}

#[derive(Deserialize)]
struct Licenses {
    allow: BTreeSet<String>,
}

#[derive(Deserialize)]
#[serde(rename_all = "kebab-case")]
struct Sources {
    allow_registry: Vec<String>,
    allow_git: Vec<String>,
}

#[derive(Deserialize)]
struct Bans {
    skip: Vec<Skip>,
}

#[derive(Deserialize)]
struct Skip {
    #[serde(rename = "crate")]
    package: String,
    reason: String,
}

fn rules() -> Rules {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/deny.toml");
    toml::from_str(&fs::read_to_string(path).expect("deny.toml is there")).expect("it is TOML")
}

/// Every package of others that something of ours is built from, by cargo's own account.
fn packages(rules: &Rules) -> BTreeMap<PackageId, Package> {
    let mut packages = BTreeMap::new();
    for target in &rules.graph.targets {
        let metadata = MetadataCommand::new()
            .cargo_path(env!("CARGO"))
            .manifest_path(concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml"))
            .other_options(["--locked", "--filter-platform", target].map(str::to_owned))
            .exec()
            .expect("cargo knows its packages");
        let ours: BTreeSet<_> = metadata.workspace_members.into_iter().collect();
        let others = metadata
            .packages
            .into_iter()
            .filter(|it| !ours.contains(&it.id));
        packages.extend(others.map(|it| (it.id.clone(), it)));
    }
    assert!(packages.len() > 100, "the firmware alone has so many");
    packages
}

/// Whether the allowed licences are enough for what a package asks. Some still write `/` for OR.
fn is_allowed(asked: &str, allowed: &BTreeSet<String>) -> bool {
    let terms = Expression::parse_mode(asked, ParseMode::LAX);
    terms.is_ok_and(|terms| {
        terms.evaluate(|term| match (&term.license, &term.addition) {
            (LicenseItem::Spdx { id, .. }, None) => allowed.contains(id.name),
            _ => false,
        })
    })
}

#[test]
fn every_package_is_under_a_licence_that_is_allowed() {
    let rules = rules();
    let refused: Vec<_> = packages(&rules)
        .into_values()
        .filter(|it| {
            let asked = it.license.as_deref().unwrap_or_default();
            !is_allowed(asked, &rules.licenses.allow)
        })
        .map(|it| (it.name.to_string(), it.license))
        .collect();
    assert_eq!(refused, []);
}

#[test]
fn a_licence_that_is_not_allowed_is_refused() {
    let allowed = rules().licenses.allow;
    for asked in ["", "GPL-3.0-only", "MIT AND MPL-2.0", "LicenseRef-own"] {
        assert!(!is_allowed(asked, &allowed), "{asked:?}");
    }
    for asked in ["MIT/GPL-2.0", "Unlicense OR MIT", "MIT AND Unicode-3.0"] {
        assert!(is_allowed(asked, &allowed), "{asked:?}");
    }
}

#[test]
fn every_package_comes_from_the_registry() {
    let rules = rules();
    assert!(rules.sources.allow_git.is_empty());
    let from = |package: &Package| {
        let source = package.source.as_ref()?.repr.strip_prefix("registry+")?;
        rules
            .sources
            .allow_registry
            .iter()
            .find(|it| *it == source)
            .cloned()
    };
    let elsewhere: Vec<_> = packages(&rules)
        .into_values()
        .filter(|it| from(it).is_none())
        .map(|it| it.id)
        .collect();
    assert_eq!(elsewhere, []);
}

#[test]
fn a_package_is_there_in_one_version_unless_a_reason_is_given() {
    let rules = rules();
    let mut excused: BTreeSet<String> = BTreeSet::new();
    for Skip { package, reason } in &rules.bans.skip {
        assert!(!reason.is_empty(), "{package} needs a reason");
        excused.insert(package.clone());
    }
    let mut versions: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for package in packages(&rules).into_values() {
        let one = format!("{}@{}", package.name, package.version);
        versions
            .entry(package.name.to_string())
            .or_default()
            .insert(one);
    }
    let mut several = BTreeSet::new();
    for versions in versions.into_values().filter(|it| it.len() > 1) {
        assert_eq!(
            versions.difference(&excused).count(),
            1,
            "one version of these is the newest, the others need a reason in deny.toml: {versions:?}"
        );
        several.extend(versions.intersection(&excused).cloned());
    }
    assert_eq!(
        several, excused,
        "entries of deny.toml that stand for something"
    );
}
